"""The legend: what colours, lines and sizes mean, and what is missing."""

_LINES = """\
| drawn | means |
| --- | --- |
| solid line | true track of a machine |
| dashed line | where it believes it was |
| yellow points | readings above the threshold |
| light red points | where it lost the plume |
| amber points and outline | last detection points that the declaration rule looked at, and their zone |
| red stake | a source that it declared |
| green stake | the true source, once something is declared (`--truth`: always) |
| points, violet to pale yellow | plume, weak to strong; radius: the filament's own size |
| arrows | flow of the water |
| turquoise points and rays | echoes of the forward ranging |
| cubes, blue to yellow | source map, from 2 % of the likeliest cell; smaller is less likely |
| violet sheet | mean depth of an interface between layers of water |
| bed, sand to navy | shallow to deep |
"""


def text(scene, scales, missing):
    """The legend of a run, Markdown."""
    lines = [f"## {scene.title or scene.scenario or 'Run'}", ""]
    if scene.run:
        lines += [f"Run `{scene.run}`.", ""]
    for line in missing:
        lines += [f"**Missing:** {line}", ""]
    lines.append(_LINES)
    words = {"plume": "Plume", "water": "Flow"}
    lines += [f"- {words[name]}: {said}." for name, said in scales.items()]
    o = scene.origin
    lines += [
        "- Lengths are true in all directions: heights are not exaggerated. The vehicle's marker has one size on the",
        "  screen at any distance; the body beneath it is to scale.",
        f"- East and north count from ({o[0]:.0f}, {o[1]:.0f}) m of the scenario's axes; z = 0 is the still surface.",
        "- Time is simulated time from the start of the mission.",
    ]
    return "\n".join(lines)
