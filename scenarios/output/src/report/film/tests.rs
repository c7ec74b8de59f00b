//! The data of the animation: of robots, of gantries, of nothing, and of what is not a number.

use super::{film, film_script, film_section, in_page};
use crate::results::{GantryInfo, GantryTrack, PlumeFilm, ProbeTables, Track};
use crate::sample::{frames, plume, source};
use crate::sample_gantry::gantry;
use crate::sample_run::{Told, told};
use nalgebra::Vector3;
use rheotaxis::frame::Frame;
use robots::handoff::Behaviour;
use serde_json::Value;

fn data(track: Track, gantries: Vec<GantryTrack>, plume_film: PlumeFilm) -> Option<Value> {
    let interfaces = vec![-2.0];
    let told = Told { track, gantries, plume_film, interfaces, ..Told::new(&frames(2), &[source()]) };
    let text = film(&told.report())?;
    assert!(!text.contains("NaN") && !text.contains('<'));
    Some(serde_json::from_str(&text).unwrap())
}

/// Sum of the steps up to each moment, in the unit of a quantum.
fn summed(steps: &Value, quantum: f64) -> Vec<f64> {
    let steps = steps.as_array().unwrap().iter().map(|v| v.as_i64().unwrap());
    let sum = |sum: &mut i64, step| {
        *sum += step;
        Some(*sum as f64 * quantum)
    };
    steps.scan(0, sum).collect()
}

#[test]
fn a_robot_is_where_its_track_is() {
    let (_, track) = told(&frames(400));
    let mut film = PlumeFilm::default();
    film.push(&plume());
    let data = data(track.clone(), Vec::new(), film).unwrap();
    let q = data["plan"]["quantum"].as_f64().unwrap();
    let robot = &data["tracks"][0];
    let (t, u, v) = (summed(&robot["t"], 0.01), summed(&robot["u"], q), summed(&robot["v"], q));
    assert!((300..=1500).contains(&t.len()), "{}", t.len());
    for (k, t_s) in t.iter().enumerate() {
        let rows = &track.robots[0].rows;
        let row = rows.iter().min_by(|a, b| (a.t_s - t_s).abs().total_cmp(&(b.t_s - t_s).abs()));
        let p = row.unwrap().p;
        assert!((p[0] - u[k]).abs() <= q && (p[1] - v[k]).abs() <= q, "{t_s}");
    }
    let does = robot["does"].as_array().unwrap();
    let moments: u64 = does.iter().skip(1).step_by(2).map(|n| n.as_u64().unwrap()).sum();
    assert_eq!(moments, t.len() as u64);
    assert_eq!(robot["declared"][0]["t"], 28_000);
    // A point is lost once, when it is new, not in each frame.
    assert_eq!(robot["lost"].as_array().unwrap().len(), 4);
    assert!(robot["lost"][0][2].as_i64().unwrap() > 20_000);
    assert!(data["plume"]["wisps"][0].as_str().unwrap().len() > 1000);
    assert_eq!(data["layers"][0], -2.0);
}

#[test]
fn what_is_not_a_number_leaves_a_gap_and_not_a_broken_page() {
    let (_, mut track) = told(&frames(50));
    let rows = &mut track.robots[0].rows;
    let n = rows.len();
    rows[3].p[0] = f64::NAN;
    rows[7].reading = Some(f64::INFINITY);
    rows[9].altitude_m = f64::NAN;
    rows[11].believed = [f64::NAN; 2];
    let data = data(track, Vec::new(), PlumeFilm::default()).unwrap();
    let robot = &data["tracks"][0];
    assert_eq!(robot["t"].as_array().unwrap().len(), n - 1);
    assert!(robot["series"][0]["values"][6].is_null() && robot["above"][8].is_null());
    assert!(data["plume"].is_null());
}

#[test]
fn several_robots_share_the_moments_and_one_without_rows_is_left_out() {
    let (_, one) = told(&frames(400));
    let mut track = Track::default();
    for k in 0..7 {
        let mut robot = one.robots[0].clone();
        robot.info.id = format!("auv{k}");
        track.robots.push(robot);
    }
    track.robots[6].rows.clear();
    let data = data(track, Vec::new(), PlumeFilm::default()).unwrap();
    let all = data["tracks"].as_array().unwrap();
    assert_eq!(all.len(), 6);
    let moments: usize = all.iter().map(|t| t["t"].as_array().unwrap().len()).sum();
    assert!(moments <= 2400, "{moments}");
    assert_eq!(all[5]["id"], "auv5");
}

#[test]
fn a_gantry_is_shown_in_centimetres_down_stream_of_the_source() {
    let at = source().position;
    let run: Vec<Frame> = (0..100)
        .map(|k| {
            let east = at.x + 1.0 - 0.005 * f64::from(k);
            let mut g = gantry(east, at.y + 0.1, Behaviour::StepUp);
            g.tips_W = vec![g.head_W + Vector3::new(0.0, 0.05, 0.0)];
            Frame { t_s: 0.1 * f64::from(k), gantries: vec![g], ..Frame::default() }
        })
        .collect();
    let info = GantryInfo { id: "crab0".into(), probes: vec!["a".into()], ..GantryInfo::default() };
    let mut tables = ProbeTables::in_memory(vec![info]);
    run.iter().for_each(|f| tables.push(f).unwrap());
    let data = data(Track::default(), tables.finish(), PlumeFilm::default()).unwrap();
    let q = data["plan"]["quantum"].as_f64().unwrap();
    let gantry = &data["tracks"][0];
    let (u, v) = (summed(&gantry["u"], q), summed(&gantry["v"], q));
    // It faces west, so that down-stream is east and left is north.
    assert!((u[0] - 100.0).abs() < 0.1 && (v[0] - 10.0).abs() < 0.1, "{} {}", u[0], v[0]);
    assert!((u[99] - 50.5).abs() < 0.1, "{}", u[99]);
    let tip = gantry["tips"][0][1].as_f64().unwrap() * q;
    assert!((tip - 5.0).abs() < 0.1, "{tip}");
    assert_eq!(data["plan"]["names"][0], "Down-stream (cm)");
}

#[test]
fn a_run_in_which_nothing_moved_has_no_animation() {
    assert!(data(Track::default(), Vec::new(), PlumeFilm::default()).is_none());
}

#[test]
fn nothing_in_the_data_ends_the_script() {
    let name = "</script><!-- & \u{2028}\u{2029}";
    let safe = in_page(&serde_json::to_string(name).unwrap());
    assert!(!safe.contains(['<', '>', '&', '\u{2028}', '\u{2029}']), "{safe}");
    assert_eq!(serde_json::from_str::<String>(&safe).unwrap(), name);
    let section = film_section("a <b>", &safe);
    assert!(section.contains("a &lt;b&gt;") && section.matches("</script>").count() == 1);
    let script = film_script();
    assert_eq!(script.matches("</script>").count(), 1);
    assert!(!script.contains("http"), "the script needs nothing from elsewhere");
}
