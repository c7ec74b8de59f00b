//! Pictures compared with the equations.

use super::bands::{GREEN, N, Rgb, each, see};
use super::light::{SCATTER_COSINE, phase};
use super::*;
use nalgebra::Vector3;
use robots::sense::{CameraSpec, LampSpec, looking};
use std::f64::consts::PI;
use std::path::Path;
use world::fields::{Clean, Concentration};
use world::frames::Pose;
use world::math;
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec, Surface};
use world::ranges::{Finite, Fraction, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;

/// The same everywhere.
struct Even(f64);

impl Concentration for Even {
    fn concentration(&self, _p: &Vector3<f64>) -> f64 {
        self.0
    }
}

/// A ball of dye with a soft edge.
struct Cloud(Vector3<f64>);

impl Concentration for Cloud {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        1e-4 * math::exp(-(p - self.0).norm_squared() / 0.18)
    }
}

const DEEP: Terrain = Terrain::Level { depth_m: 200.0 };
const BED: Terrain = Terrain::Level { depth_m: 6.0 };

/// A wall east of x = 3 m, much larger than the picture.
fn wall(albedo: f64) -> Obstacles {
    let (m, f) = (Positive::new, Fraction::new(albedo));
    let spec = ObstacleSpec {
        surface: Surface { albedo: (f, f, f), ..Surface::default() },
        id: "wall".into(),
        shape: ShapeSpec::Box(BoxShape { size_m: (m(2.0), m(60.0), m(190.0)) }),
        east_m: Finite::new(4.0),
        north_m: Finite::new(0.0),
        base: Base::Z(Finite::new(-195.0)),
        heading_deg: HeadingDeg::new(90.0),
    };
    Obstacles(vec![Obstacle::build(&spec, &DEEP, Path::new(".")).unwrap()])
}

/// Smooth surfaces under a steady light.
fn plain(change: impl Fn(&mut OpticsSpec)) -> Optics {
    let mut spec = OpticsSpec { texture: Fraction::new(0.0), ..OpticsSpec::default() };
    spec.light.flicker = Fraction::new(0.0);
    change(&mut spec);
    Optics::new(&spec).unwrap()
}

fn no_scattering(spec: &mut OpticsSpec) {
    let none = NonNegative::new(0.0);
    spec.clarity.scattering_per_m = Some((none, none, none));
}

/// 41 × 31 pixels: the middle one looks along the axis.
fn camera() -> CameraSpec {
    CameraSpec { width: 41, height: 31, ..CameraSpec::default() }
}

/// 5 m down, looking east on the level.
fn level() -> Pose {
    looking(Vector3::new(0.0, 0.0, -5.0), 0.0, 0.0)
}

fn take(optics: &Optics, terrain: &Terrain, obstacles: &Obstacles, dye: &dyn Concentration) -> RenderedPicture {
    let scene = Scene { terrain, obstacles, dye, optics };
    render(&camera(), &level(), &scene, 9)
}

fn middle(made: &RenderedPicture) -> Rgb {
    made.radiance[15 * 41 + 20].map(f64::from)
}

fn near(got: Rgb, want: Rgb, part: f64) {
    for (g, w) in got.into_iter().zip(want) {
        assert!((g - w).abs() <= part * w.abs(), "{got:?}, not {want:?}");
    }
}

#[test]
fn a_wall_fades_with_the_beam_attenuation_alone_where_nothing_scatters() {
    let o = plain(no_scattering);
    let face = o.light.on(&-Vector3::x());
    let (lit, a) = (o.light.irradiance(-5.0), o.clarity.absorption);
    let bare = each(|i| 0.3 / PI * lit[i] * face * math::exp(-a[i] * 3.0));
    let made = take(&o, &DEEP, &wall(0.3), &Clean);
    near(middle(&made), see(&bare), 1e-6);
    // Even dye that does not fluoresce: the same with its own absorption; its steps add up exactly.
    let o = plain(|s| {
        no_scattering(s);
        s.dye.quantum_yield = Fraction::new(0.0);
    });
    let rho = 2e-5;
    let dyed = each(|i| bare[i] * math::exp(-rho * o.dye.absorption[i] * 3.0));
    let made = take(&o, &DEEP, &wall(0.3), &Even(rho));
    // Within a step transmission is taken as linear: an error of at most (dτ)²/8, for steps of 4.2 % of the distance.
    let strongest = o.dye.absorption.into_iter().fold(0.0, f64::max);
    let step = 0.042 * 3.0 * rho * strongest;
    near(middle(&made), see(&dyed), step * step / 8.0);
    let seen = made.seen[15 * 41 + 20];
    let through = math::exp(-rho * o.dye.absorption[GREEN] * 3.0);
    assert!((f64::from(seen.opacity) - (1.0 - through)).abs() < step * step / 8.0);
    assert_eq!(seen.obstacle, Some(0));
    assert!((seen.way_m - 3.0).abs() < 1e-6);
}

#[test]
fn the_veil_grows_to_the_colour_of_endless_water() {
    let o = plain(|_| {});
    let far = o.light.endless(&o.clarity, -5.0, &Vector3::x());
    near(middle(&take(&o, &DEEP, &Obstacles::default(), &Clean)), see(&far), 1e-3);
    let c = o.clarity.attenuation;
    let part = each(|i| far[i] * (1.0 - math::exp(-c[i] * 3.0)));
    near(middle(&take(&o, &DEEP, &wall(0.0), &Clean)), see(&part), 1e-3);
    // Murkier water hides the wall: at the range of visibility 0.8 % of the contrast at 530 nm is left, and about as
    // much in all green.
    let murky = plain(|s| s.clarity.visibility_m = Positive::new(3.0));
    let far = see(&murky.light.endless(&murky.clarity, -5.0, &Vector3::x()));
    let got = middle(&take(&murky, &DEEP, &wall(0.0), &Clean));
    let contrast = (far[1] - got[1]) / far[1];
    assert!((contrast - math::exp(-4.8)).abs() < 1e-3, "{contrast}");
}

#[test]
fn thick_dye_glows_as_bright_as_what_reaches_it_allows() {
    let o = plain(no_scattering);
    let rho = 1e-3;
    let got = middle(&take(&o, &DEEP, &Obstacles::default(), &Even(rho)));
    let (lit, d, c) = (o.light.irradiance(-5.0), o.dye, o.clarity.attenuation);
    let front = o.light.from_front(&Vector3::x());
    // From the sun through 4.5 m of dye, as far as it is followed: some light is left where the dye hardly absorbs.
    let above = rho * 4.5;
    let want = each(|i| {
        let own = c[i] + rho * d.absorption[i];
        let sum: f64 = (0..N)
            .map(|j| {
                let ahead = front / (own + rho * d.absorption[j]);
                let shade = (1.0 - front) * math::exp(-above * d.absorption[j]) / own;
                d.glow[i][j] * lit[j] * (ahead + shade)
            })
            .sum();
        rho * sum / (4.0 * PI)
    });
    near(got, see(&want), 1e-4);
    assert!(got[0] > 1.5 * got[1] && got[1] > got[2], "{got:?}");
}

#[test]
fn a_lamp_alone_lights_by_the_square_of_the_distance_and_both_ways_through_the_water() {
    let o = plain(|s| {
        no_scattering(s);
        s.light.illuminance_klux = Positive::new(1e-12);
    });
    let camera = CameraSpec { lamp: Some(LampSpec { right_m: Finite::new(0.0), ..LampSpec::default() }), ..camera() };
    let walls = wall(0.3);
    let scene = Scene { terrain: &DEEP, obstacles: &walls, dye: &Clean, optics: &o };
    let got = middle(&render(&camera, &level(), &scene, 0));
    let a = o.clarity.absorption;
    near(got, see(&each(|i| 0.3 / PI * 2000.0 / 9.0 * math::exp(-a[i] * 6.0))), 1e-6);
    // Scattering water sends some light back before any surface: less than forward, more than nothing.
    let o = plain(|s| s.light.illuminance_klux = Positive::new(1e-12));
    let scene = Scene { obstacles: &Obstacles::default(), optics: &o, ..scene };
    let got = middle(&render(&camera, &level(), &scene, 0))[1];
    // From 5 cm on, the lamp's near field, to endless range, in steps of a millimetre.
    let (b, c) = (o.clarity.scattering[GREEN], o.clarity.attenuation[GREEN]);
    let back: f64 = (0..20_000)
        .map(|k| 1e-3 * (f64::from(k) + 0.5))
        .map(|r| 1e-3 * math::exp(-2.0 * c * r) / r.max(0.05).powi(2))
        .sum();
    let want = 2000.0 * b * phase(SCATTER_COSINE, -1.0) * back;
    // The first step is much longer than the distance of the lamp: its share is only roughly right.
    assert!(got > 0.1 * want && got < 2.0 * want, "{got} {want}");
}

#[test]
fn dye_reddens_the_picture_and_nothing_else_does() {
    let mut spec = OpticsSpec::default();
    spec.clarity.visibility_m = Positive::new(20.0);
    let o = Optics::new(&spec).unwrap();
    let cloud = Cloud(Vector3::new(2.5, 0.0, -5.0));
    let clean = take(&o, &BED, &Obstacles::default(), &Clean);
    let dyed = take(&o, &BED, &Obstacles::default(), &cloud);
    assert!(clean.seen.iter().all(|s| s.plume == 0.0 && s.opacity == 0.0));
    let red = |l: &[f32; 3]| l[0] / l[1];
    let (mut in_it, mut beside) = (0, 0);
    for (n, seen) in dyed.seen.iter().enumerate() {
        let ratio = red(&dyed.radiance[n]) / red(&clean.radiance[n]);
        if seen.plume > 0.2 {
            in_it += 1;
            assert!(ratio > 1.1, "pixel {n}: {ratio}");
        } else if seen.plume < 1e-3 {
            beside += 1;
            assert!((ratio - 1.0).abs() < 3e-3, "pixel {n}: {ratio}");
        }
    }
    assert!(in_it > 50 && beside > 200, "{in_it} {beside}");
    // The cloud is in the middle of the picture.
    let middle = dyed.seen[15 * 41 + 20];
    let depth = 1e-4 * o.dye.absorption[GREEN] * (0.18 * PI).sqrt();
    let opacity = 1.0 - math::exp(-depth);
    assert!((f64::from(middle.opacity) - opacity).abs() < 0.01, "{middle:?} {opacity}");
    assert!(middle.plume > 0.3, "{middle:?}");
}

#[test]
fn light_is_finite_and_never_negative() {
    // Each height with each water; the views take turns.
    let views = [(0.0, 1.57), (1.0, 0.4), (2.0, -0.6), (3.0, -1.5)];
    let mut views = views.iter().cycle();
    for visibility_m in [0.3, 2.0, 10.0, 60.0] {
        let o = plain(|s| {
            s.clarity.visibility_m = Positive::new(visibility_m);
            s.dye.scattering_m2_kg = NonNegative::new(1000.0);
        });
        for z in [-0.2, -3.0, -5.9] {
            let (yaw, down) = *views.next().unwrap();
            let cloud = Cloud(Vector3::new(0.5, 0.3, z));
            let scene = Scene { terrain: &BED, obstacles: &Obstacles::default(), dye: &cloud, optics: &o };
            let pose = looking(Vector3::new(0.0, 0.0, z), yaw, down);
            let made = render(&camera(), &pose, &scene, 0);
            for (l, s) in made.radiance.iter().zip(&made.seen) {
                assert!(l.iter().all(|v| v.is_finite() && *v >= 0.0), "{l:?}");
                for share in [s.plume, s.opacity, s.clear] {
                    assert!((-1e-6..=1.0).contains(&share), "{s:?}");
                }
            }
        }
    }
}

#[test]
fn a_picture_repeats_bit_for_bit_and_its_noise_follows_its_seed_alone() {
    let o = Optics::new(&OpticsSpec::default()).unwrap();
    let cloud = Cloud(Vector3::new(2.0, 0.4, -5.2));
    let scene = Scene { terrain: &BED, obstacles: &Obstacles::default(), dye: &cloud, optics: &o };
    let made = |noise| render(&camera(), &level(), &scene, noise);
    let (one, same, other) = (made(1), made(1), made(2));
    assert_eq!(one, same);
    assert_eq!(one.radiance, other.radiance);
    assert_ne!(one.image, other.image);
}

#[test]
fn any_size_of_picture_can_be_made() {
    let o = Optics::new(&OpticsSpec::default()).unwrap();
    for (width, height) in [(1, 1), (1, 7), (160, 3), (3, 161)] {
        let camera = CameraSpec { width, height, ..camera() };
        let scene = Scene {
            terrain: &BED,
            obstacles: &Obstacles::default(),
            dye: &Cloud(Vector3::new(2.0, 0.0, -5.0)),
            optics: &o,
        };
        let made = render(&camera, &level(), &scene, 0);
        assert_eq!(made.image.dimensions(), (width, height));
        assert_eq!(made.seen.len(), (width * height) as usize);
    }
}
