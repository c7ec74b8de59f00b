//! Pictures of a place that are rendered and added up: what they say of water and source.

use eyes::camera::{ClaritySpec, LightSpec, Optics, OpticsSpec, Scene, render};
use eyes::vision::place::{PlacePictures, Stand, Useless};
use image::RgbImage;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use robots::handoff::{Picture, Verdict};
use robots::sense::{CameraSpec, looking, turned};
use robots::strategy::AddUpSpec;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::sync::Arc;
use world::fields::Concentration;
use world::math;
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec, Surface};
use world::ranges::{Finite, Fraction, HeadingDeg, Positive};
use world::terrain::Terrain;
use world::units::Heading;

const BED: Terrain = Terrain::Level { depth_m: 8.0 };

/// A steady plume from the origin to the east, 0.55 m above the bed, that widens with the root of its way; up to some
/// place in the west if it only passes by.
struct Dye {
    kg_s: f64,
    from_m: f64,
}

impl Concentration for Dye {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        let way = p.x - self.from_m;
        if way <= 0.0 || self.kg_s == 0.0 {
            return 0.0;
        }
        let s2 = 0.01 + 0.02 * way;
        let (y, z) = (p.y, p.z + 8.0 - 0.55);
        let peak = self.kg_s / (2.0 * std::f64::consts::PI * s2 * 0.15);
        peak * math::exp(-0.5 * (y * y + z * z) / s2)
    }
}

/// What lies at the origin, in which water.
struct Sea {
    visibility_m: f64,
    light_klx: f64,
    body: Option<[f64; 3]>,
    dye: Dye,
}

fn sea(visibility_m: f64, body: Option<[f64; 3]>, kg_s: f64) -> Sea {
    Sea { visibility_m, light_klx: 60.0, body, dye: Dye { kg_s, from_m: 0.0 } }
}

/// The source: dark, with 2 g of dye a minute.
fn source(visibility_m: f64) -> Sea {
    sea(visibility_m, Some([0.05, 0.05, 0.06]), 3.3e-5)
}

impl Sea {
    /// Pictures from places (east, north, altitude), looking straight down with the nose to the east.
    fn pictures(&self, from: &[[f64; 3]], noise: u64) -> Vec<(Picture, Stand)> {
        let optics = Optics::new(&OpticsSpec {
            clarity: ClaritySpec { visibility_m: Positive::new(self.visibility_m), ..ClaritySpec::default() },
            light: LightSpec { illuminance_klux: Positive::new(self.light_klx), ..LightSpec::default() },
            ..OpticsSpec::default()
        });
        let optics = optics.expect("legal");
        let body = self.body.map(|albedo| {
            let [r, g, b] = albedo.map(Fraction::new);
            let [l, w, h] = [1.0, 0.5, 0.5].map(Positive::new);
            let spec = ObstacleSpec {
                id: "body".to_string(),
                shape: ShapeSpec::Box(BoxShape { size_m: (l, w, h) }),
                east_m: Finite::new(0.0),
                north_m: Finite::new(0.0),
                base: Base::default(),
                heading_deg: HeadingDeg::new(0.0),
                surface: Surface { albedo: (r, g, b), ..Surface::default() },
            };
            Obstacle::build(&spec, &BED, Path::new("")).expect("a body")
        });
        let obstacles = Obstacles(body.into_iter().collect());
        let scene = Scene { terrain: &BED, obstacles: &obstacles, dye: &self.dye, optics: &optics };
        let camera = CameraSpec { width: 48, height: 36, view_deg: Positive::new(90.0), ..CameraSpec::default() };
        let one = |(n, at): (usize, &[f64; 3])| {
            let [east, north, altitude_m] = *at;
            let pose = looking(Vector3::new(east, north, altitude_m - 8.0), 0.0, FRAC_PI_2);
            let made = render(&camera, &pose, &scene, noise + n as u64);
            let stand = Stand { position: Vector2::new(east, north), altitude_m, R_WB: UnitQuaternion::identity() };
            (shown(made.image), stand)
        };
        from.iter().enumerate().map(one).collect()
    }
}

fn shown(image: RgbImage) -> Picture {
    Picture { image: Arc::new(image), p_BC: Vector3::zeros(), R_BC: turned(0.0, FRAC_PI_2), view_rad: FRAC_PI_2 }
}

fn place(within_m: f64) -> PlacePictures {
    let spec = AddUpSpec { within_m: Positive::new(within_m), ..AddUpSpec::default() };
    PlacePictures::new(&spec, Vector2::zeros(), Heading::from_deg(90.0))
}

fn add(place: &mut PlacePictures, pictures: &[(Picture, Stand)]) {
    for (picture, stand) in pictures {
        place.add(picture, stand).expect("a picture of the bed");
    }
}

/// Stands along the flow, from -6 to 6 m, over a strip `north` of the place.
fn line(north: f64, altitude_m: f64) -> Vec<[f64; 3]> {
    (0..9).map(|k| [1.5 * f64::from(k) - 6.0, north, altitude_m]).collect()
}

/// The beam attenuation that the renderer used comes back from its pictures of the bare bed within 30 %, from two
/// heights as a survey in that water flies them.
#[test]
fn the_pictures_show_how_clear_the_water_is() {
    for (visibility_m, heights) in
        [(2.0, [2.0, 1.4]), (3.0, [2.5, 1.4]), (4.5, [2.5, 1.4]), (6.0, [2.5, 2.0]), (9.0, [2.5, 2.5])]
    {
        let bare = sea(visibility_m, None, 0.0);
        let stands: Vec<[f64; 3]> =
            (0..8).map(|k| [7.0 * f64::from(k), 3.0 * f64::from(k), heights[k as usize % 2]]).collect();
        let mut place = place(3.0);
        add(&mut place, &bare.pictures(&stands, 1));
        let seen_m = place.clarity().expect("pictures").visibility_m();
        let off = (seen_m / visibility_m - 1.0).abs();
        assert!(off < 0.3, "{visibility_m} m looks like {seen_m:.2} m");
    }
}

#[test]
fn all_pictures_of_a_line_verify_a_source_and_find_its_place() {
    let mut place = place(3.0);
    add(&mut place, &source(8.0).pictures(&line(0.0, 2.5), 1));
    let said = place.weigh();
    assert_eq!(said.answer, Verdict::Verified, "{:.1}", said.log_factor);
    let off = said.best.expect("a place").norm();
    assert!(off < 0.7, "{off}");
}

/// Other things, and water too murky for anything: never a source, and a rejection only if enough was to be seen.
#[test]
fn what_is_no_source_is_rejected_or_left_open() {
    let dark = Some([0.08, 0.08, 0.07]);
    let red = Some([0.5, 0.08, 0.08]);
    let passing = Sea { dye: Dye { kg_s: 3.3e-5, from_m: -20.0 }, ..sea(8.0, dark, 0.0) };
    for (what, there) in [
        ("bed", sea(8.0, None, 0.0)),
        ("rock", sea(8.0, dark, 0.0)),
        ("red thing", sea(8.0, red, 0.0)),
        ("rock in passing dye", passing),
    ] {
        let mut place = place(2.0);
        for (n, north) in [0.0, 1.5, -1.5].into_iter().enumerate() {
            add(&mut place, &there.pictures(&line(north, 2.5), 10 * n as u64));
        }
        let said = place.weigh();
        // Dye that passes by as a wide band is partly taken for background: it may stay open.
        let may = if what == "rock in passing dye" {
            [Verdict::Rejected, Verdict::CannotTell]
        } else {
            [Verdict::Rejected; 2]
        };
        assert!(may.contains(&said.answer) && said.log_factor < 0.0, "{what}: {:.1}", said.log_factor);
    }
    let mut murky = place(2.0);
    add(&mut murky, &source(1.2).pictures(&line(0.0, 2.5), 1));
    let said = murky.weigh();
    assert_eq!(said.answer, Verdict::CannotTell, "{:.1}", said.log_factor);
    let mut elsewhere = place(3.0);
    add(&mut elsewhere, &sea(8.0, None, 0.0).pictures(&line(0.0, 1.4), 1));
    let said = elsewhere.weigh();
    assert_eq!(said.answer, Verdict::CannotTell, "most of it was not seen: {:.1}", said.log_factor);
}

/// At dusk the noise limits what a pass shows: four passes say more than one, and one pass shown four times says no
/// more
/// than once.
#[test]
fn evidence_adds_up_over_pictures_and_not_over_copies() {
    let dusk = Sea { light_klx: 1.0, ..source(8.0) };
    let passes: Vec<_> = (1..5).map(|k| dusk.pictures(&line(0.0, 2.0), 100 * k)).collect();
    let mut place = place(2.0);
    add(&mut place, &passes[0]);
    let once = place.weigh();
    assert_eq!(once.answer, Verdict::CannotTell, "{:.1}", once.log_factor);
    let mut copied = place.clone();
    for _ in 1..4 {
        add(&mut copied, &passes[0]);
    }
    let copied = copied.weigh().log_factor;
    assert!(copied <= once.log_factor + 0.5, "{copied} {}", once.log_factor);
    for pass in &passes[1..] {
        add(&mut place, pass);
    }
    let all = place.weigh();
    assert!(all.log_factor > once.log_factor + 1.0, "{} {}", all.log_factor, once.log_factor);
    assert_eq!(all.answer, Verdict::Verified, "{:.1}", all.log_factor);
}

/// The second pass believes itself 0.6 m farther north than it is; half of that at least is taken out.
#[test]
fn overlap_takes_out_an_error_of_the_navigation() {
    let clear = source(10.0);
    let mut place = place(2.0);
    add(&mut place, &clear.pictures(&line(0.0, 2.5), 1));
    let mut second = clear.pictures(&line(0.3, 2.5), 50);
    second.iter_mut().for_each(|(_, s)| s.position.y += 0.6);
    add(&mut place, &second);
    let back = place.shift_m();
    assert!((back - Vector2::new(0.0, -0.6)).norm() < 0.3, "{back}");
}

#[test]
fn pictures_of_nothing_leave_it_open() {
    let stand = Stand { position: Vector2::zeros(), altitude_m: 2.0, R_WB: UnitQuaternion::identity() };
    let mut place = place(2.0);
    assert_eq!(place.weigh().answer, Verdict::CannotTell);
    // On the bed, or looking at the surface, it sees none of the ground.
    let (picture, _) = sea(8.0, None, 0.0).pictures(&[[0.0, 0.0, 2.0]], 1).remove(0);
    let low = Stand { altitude_m: 0.0, ..stand };
    assert_eq!(place.add(&picture, &low), Err(Useless::Empty));
    let up = Stand { R_WB: UnitQuaternion::from_euler_angles(std::f64::consts::PI, 0.0, 0.0), ..stand };
    assert_eq!(place.add(&picture, &up), Err(Useless::Empty));
    assert_eq!(place.pictures(), [0, 2]);
    let said = place.weigh();
    assert_eq!((said.answer, said.log_factor), (Verdict::CannotTell, 0.0));
}
