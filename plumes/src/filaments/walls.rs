//! Filaments between side walls: eddies carry them, and walls, bed and surface reflect them.
//!
//! *Source*: reflection at a solid wall (Thomson 1987, J. Fluid Mech. 180, 529, section 4).
//!
//! *Parameters*: [`CARRY_S`], the step of the eddies.
//!
//! *Deviations*: the eddies act after mean flow and kicks (splitting, Strang 1968, SIAM J. Numer. Anal. 5, 506; first
//! order in the step), and in longer steps: in the frame that moves with the stream, in which they are evaluated, they
//! change over seconds.

use super::kernel::folded;
use super::store::Store;
use world::fields::{Flow, SideWalls};

/// Step of the eddies, s, unless that of the drift is longer: at a few mm/s a filament moves by a millimetre in it.
pub(super) const CARRY_S: f64 = 0.2;

/// Carries the filaments with the eddies from `since_s`, or their release, to `now_s`.
pub(super) fn carry(flow: &dyn Flow, store: &mut Store, since_s: f64, now_s: f64) {
    let whole = (now_s - since_s) as f32;
    let mut dt = vec![whole; store.len()];
    // The newest filaments come last.
    for (dt, born) in dt.iter_mut().zip(&store.born_s).rev() {
        if *born <= since_s {
            break;
        }
        *dt = (now_s - born) as f32;
    }
    flow.carry(now_s, &dt, [&mut store.x, &mut store.y, &mut store.z]);
    for (z, bed) in store.z.iter_mut().zip(&store.bed) {
        *z = folded(*z, *bed, -1.0 / bed);
    }
}

/// Mirrors filaments that passed a wall back into the water.
pub(super) fn keep_between(walls: &SideWalls, store: &mut Store) {
    let (ax, ay) = (walls.across.x as f32, walls.across.y as f32);
    let (cx, cy) = (walls.centre.x as f32, walls.centre.y as f32);
    let half = walls.half_width_m as f32;
    for (x, y) in store.x.iter_mut().zip(&mut store.y) {
        let side = (*x - cx) * ax + (*y - cy) * ay;
        if side.abs() > half {
            // No kick is longer than the distance between the walls; the clamp would hold even such a filament inside.
            let back = (2.0 * half).copysign(side) - side;
            let turn = back.clamp(-half, half) - side;
            *x += turn * ax;
            *y += turn * ay;
        }
    }
}
