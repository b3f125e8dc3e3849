// The report on one run, or on several that are overlaid.

class RunView {
  constructor(data, several) {
    Object.assign(this, data);
    this.several = several;
    this.series = new Series(data.series);
    try {
      this.animation = data.animation ? new Animation(data.animation) : null;
    } catch (error) {
      this.animation = null; // plots and tables remain
      this.error = error;
    }
    this.title = data.result.title || data.name;
  }

  label(text) {
    return this.several ? `${text}: ${this.name}` : text;
  }
}

// What was left out of the file.
function kept_text(runs) {
  const texts = [];
  for (const { series, animation, name } of runs) {
    const of = runs.length > 1 ? ` of ${name}` : "";
    if (series.interval > 1)
      texts.push(`Plots${of} show least and largest values of every ${count_text(series.interval)} of ${count_text(series.rows)} rows`);
    if (animation && animation.stride > 1)
      texts.push(`the animation${of} every ${count_text(animation.stride)}${animation.stride === 2 ? "nd" : "th"} of ${count_text(animation.total)} frames`);
  }
  if (texts.length === 0) return null;
  const text = texts.join("; ");
  return element("p", { class: "soft" }, `${text[0].toUpperCase()}${text.slice(1)}. The run's files have all of it.`);
}

function names_made_unique(runs) {
  const titles = runs.map((run) => run.name);
  runs.forEach((run, k) => {
    if (titles.indexOf(run.name) !== k) run.name = `${run.name} (${k + 1})`;
  });
}

function show_runs(data, root) {
  names_made_unique(data.runs);
  const several = data.runs.length > 1, runs = data.runs.map((run) => new RunView(run, several));
  const titles = [...new Set(runs.map((run) => run.title))];
  root.append(element("h1", {}, titles.length === 1 ? titles[0] : titles.join(" and ")));
  if (several) root.append(element("p", { class: "soft" }, `Runs: ${runs.map((run) => run.name).join(", ")}`));
  for (const run of runs) {
    root.append(...[status_line(run), ...warnings_of(run)].filter(Boolean));
    if (run.error) show_error(root, run.error);
  }
  root.append(kept_text(runs) || "");
  const clock = new Clock(Math.min(...runs.map((r) => r.series.t[0])), Math.max(...runs.map((r) => r.series.t[r.series.t.length - 1])));
  const part = (draw) => guarded(root, () => root.append(...[draw()].flat().filter(Boolean)));
  part(() => animation_section(runs, clock));
  part(() => plots_section(runs, clock));
  part(() => runs.map((run) => events_card(run, clock)));
  part(() => runs.map((run) => facts_section(run)));
}

function animation_section(runs, clock) {
  const drawn_runs = runs.filter((run) => run.animation);
  if (drawn_runs.length === 0) return element("p", { class: "soft" }, "No body of this scene is drawn: there is no animation.");
  const stage = new Stage(drawn_runs.map((run, k) => ({ animation: run.animation, still: run.result.drawing || {},
    tint: colour_of(k), name: run.name })));
  const player = new Player(stage, clock, [forces_text(stage)]);
  window.trammel_report = { clock, stage };
  return player.root;
}

function forces_text(stage) {
  if (!(stage.largest > 0)) return null;
  const kinds = [["contact_names", 1, " contacts, on their first side"], ["force_names", 3, " force elements"]];
  const swatches = kinds.filter(([names]) => stage.actors.some(({ animation }) => animation[names].length > 0))
    .map(([, colour, text]) => [" ", element("span", { class: "swatch", style: `background:${colour_of(colour)}` }), text]);
  return element("p", { class: "soft" }, `Arrows: forces, the longest ${number_text(stage.largest, 3)} N;`, swatches);
}
