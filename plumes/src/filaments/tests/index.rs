//! The index compared with a search through all filaments.

use crate::filaments::query::index::Index;
use crate::filaments::query::packet::{PACKET, Packet};
use crate::filaments::query::question::Question;
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Bands;
use crate::filaments::store::size::Size;
use crate::filaments::walls::domain::Domain;
use crate::filaments::water::lookup::Lookup;
use crate::flow::grid::{FlowGrid, GridShape};
use crate::release::ReleaseSpec;
use crate::simd::dispatch::InstructionSet;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

/// Nothing but bed and surface, and a cloud of filaments of all ages in 6 m of water. Each takes a step of some metres
/// between -4 s and 4 s.
struct Scene {
    room: Domain,
    lookup: Lookup,
    stores: [Store; 1],
    bands: Bands,
}

impl Scene {
    fn over(n: usize, bed: &Terrain) -> Self {
        let area = Area { centre: Vector2::zeros(), length_m: 400.0, width_m: 400.0, axis: Heading::from_deg(90.0) };
        let grid = FlowGrid::new(&area, bed, GridShape::default());
        let mut s = Store::new(Size::new(&ReleaseSpec::default()), 1e-6);
        let mut r = Stream::new(5, "test", "cloud");
        for k in 0..n {
            let age = (n - k) as f64 * 0.2;
            let [x, y] = [0.1 * age, 0.2 * age.sqrt() * r.normal()];
            let p = [x, y, bed.bed_z(x, y) * r.uniform()];
            // The last ones are released during the step.
            let end = bed.bed_z(x + 2.0, y - 1.0) as f32;
            s.push(p.map(|v| v as f32), end, 3.0 - age);
            s.x[k] += 2.0;
            s.y[k] -= 1.0;
        }
        let mut bands = Bands::single(-4.0, 4.0);
        bands.pass();
        Self { room: Domain::new(&grid), lookup: Lookup::new(&grid), stores: [s], bands }
    }

    fn at(&self, index: &Index, path: InstructionSet, now_s: f64, p: &Vector3<f64>) -> f64 {
        let query =
            Question { stores: &self.stores, bands: &self.bands, room: &self.room, lookup: &self.lookup, path, now_s };
        index.concentration(&query, p.map(|v| v as f32).into())
    }

    /// All filaments in leaves, in the order of release.
    fn all(&self, now_s: f64) -> Vec<Packet> {
        let s = &self.stores[0];
        let moment = self.bands.moment(0, now_s);
        let place = |i| Some((i, s.place(i, &moment)?));
        let there: Vec<_> = (0..s.len()).filter_map(place).collect();
        let packet = |part: &[(usize, [f32; 3])]| {
            let mut packet = Packet::default();
            for (n, (i, p)) in part.iter().enumerate() {
                let sh = s.size.horizontal(now_s - s.born_s[*i]);
                (packet.x[n], packet.y[n], packet.z[n]) = (p[0], p[1], p[2]);
                (packet.h[n], packet.v[n]) = (sh, s.size.vertical(sh, -6.0));
                packet.bed[n] = -6.0;
            }
            packet.count = part.len();
            packet.seal(InstructionSet::Portable, s.filament_kg * QUANTA);
            packet
        };
        there.chunks(PACKET).map(packet).collect()
    }
}

/// In a kg/m³, for the search through all.
const QUANTA: f64 = 1e17;

fn fresh() -> Index {
    let mut index = Index::default();
    index.clear(1);
    index
}

#[test]
fn index_finds_all_that_a_full_search_finds_at_any_time_of_a_step() {
    let scene = Scene::over(5000, &Terrain::Level { depth_m: 6.0 });
    let mut index = fresh();
    let mut r = Stream::new(6, "test", "probe");
    let mut hits = 0;
    for now_s in [-4.0, -1.0, 2.9, 4.0] {
        index.forget();
        let all = scene.all(now_s);
        for _ in 0..1000 {
            let p = Vector3::new(110.0 * r.uniform(), 10.0 * r.uniform() - 5.0, -6.0 * r.uniform());
            let got = scene.at(&index, InstructionSet::detect(), now_s, &p);
            let q = [p.x as f32, p.y as f32, p.z as f32];
            let want: i64 = all.iter().map(|l| l.concentration(InstructionSet::Portable, q)).sum();
            let want = want as f64 / QUANTA;
            assert!((got - want).abs() <= 1e-5 * want, "{now_s}: {got} {want}");
            hits += usize::from(want > 0.0);
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn batches_answer_as_scans_do_with_every_path_and_over_any_bed() {
    let area = Area { centre: Vector2::new(55.0, 0.0), length_m: 110.0, width_m: 60.0, axis: Heading::from_deg(90.0) };
    let steep = Terrain::sloping_over(&area, Heading::from_deg(70.0), 0.5, 9.0);
    let (flat, deep) = (Terrain::Level { depth_m: 1.2 }, Terrain::Level { depth_m: 6.0 });
    let mut r = Stream::new(8, "test", "probe");
    for (bed, n) in [(&steep, 5000), (&flat, 3000), (&deep, 40), (&deep, 3000)] {
        let scene = Scene::over(n, bed);
        for path in InstructionSet::all() {
            let mut index = fresh();
            let mut hits = 0;
            for now_s in [-1.0, 2.9] {
                index.forget();
                for k in 0..400 {
                    // Beside a filament, within a few times its size.
                    let (s, of) = (&scene.stores[0], (r.uniform() * n as f64) as usize);
                    let Some(at) = s.place(of, &scene.bands.moment(0, now_s)) else {
                        continue;
                    };
                    let size = f64::from(s.size.horizontal(now_s - s.born_s[of]));
                    let mut p = Vector3::from_fn(|d, _| f64::from(at[d]) + size * r.normal());
                    p.z = p.z.clamp(bed.bed_z(p.x, p.y), 0.0);
                    let batch = scene.at(&index, path, now_s, &p);
                    let scan = scene.at(&fresh(), InstructionSet::Portable, now_s, &p);
                    assert_eq!(batch.to_bits(), scan.to_bits(), "{path:?} {n} {k}");
                    hits += usize::from(batch > 0.0);
                }
            }
            assert!(hits > 200, "{n}: {hits}");
        }
    }
}

#[test]
fn nothing_is_felt_above_the_surface() {
    let scene = Scene::over(1000, &Terrain::Level { depth_m: 6.0 });
    let at = |z: f64| scene.at(&fresh(), InstructionSet::detect(), 0.0, &Vector3::new(15.0, 0.0, z));
    assert!(at(-1e-6) > 0.0 && at(1e-6) == 0.0);
}
