//! `report.html`: one self-contained file.

use super::film::FILM_STYLE;
use super::page::Page;
use crate::charts::escaped;
use crate::results::{Fact, ShownPicture, Summary};

/// The page: summary, animation (its data), figures (title and SVG), a camera's pictures, scenario.
pub(super) fn page(
    summary: &Summary,
    film: Option<&str>,
    figures: &[(String, String)],
    pictures: &[ShownPicture],
    scenario_text: &str,
) -> String {
    let name = format!("{}, seed {}", summary.scenario, summary.seed);
    let mut page = Page::new(&name, &summary.title, film.map_or("", |_| FILM_STYLE));
    page.html(&format!(
        "<p>{}. Success: {}.<br>Outcome: <span class=\"outcome\">{}</span>.</p>\n",
        escaped(&name),
        escaped(&summary.success_rule),
        summary.outcome.label()
    ));
    if let Some(e) = &summary.error {
        page.paragraph(&format!("Error: {e}"));
    }
    if !summary.abnormal.is_empty() {
        let rows: Vec<(&str, String)> = summary.abnormal.iter().map(|a| (a.robot.as_str(), a.line.clone())).collect();
        page.facts("What went wrong", &rows);
    }
    let rows = |facts: Vec<Fact>| facts.into_iter().map(|f| (f.name, f.value)).collect::<Vec<_>>();
    for (kind, id, facts) in summary.machine_facts() {
        page.facts(&format!("{kind} {id}"), &rows(facts));
    }
    page.facts("Run", &rows(summary.run_facts()));
    if let Some(film) = film {
        page.film("Mission in motion", film);
    }
    for (title, svg) in figures {
        page.html(&format!("<figure><h2>{}</h2>\n{svg}</figure>\n", escaped(title)));
    }
    if !pictures.is_empty() {
        page.heading("Pictures");
        page.html("<div class=\"pictures\">\n");
        for p in pictures {
            let (html, title) = (p.html(), escaped(&p.title()));
            page.html(&format!("<figure>{html}<figcaption>{title}</figcaption></figure>\n"));
        }
        page.html("</div>\n");
    }
    page.heading("Scenario");
    page.html(&format!("<pre>{}</pre>\n", escaped(scenario_text)));
    page.end()
}
