// Which plots a report has: the observed columns by unit, energies, their balance, norms of the constraints, step sizes,
// contact forces; of several runs overlaid, and on demand as differences from the first.

const MOST_CURVES = 6;      // in one plot
const MOST_CONTACTS = 6;    // with a curve of their force

// Curves of some columns for all runs: columns by colour, runs by dash; of a single column runs by colour.
function curves_of(runs, columns) {
  const curves = [];
  runs.forEach((run, r) => columns.forEach((column, c) => {
    const values = run.series.values(column.name);
    if (!values) return;
    const alone = columns.length === 1;
    const name = runs.length === 1 ? column.name : alone ? run.name : `${column.name}, ${run.name}`;
    curves.push({ name, t: run.series.t, values, colour: colour_of(alone ? r : c),
      dash: runs.length === 1 ? [] : dash_numbers(r) });
  }));
  return curves;
}

const dash_numbers = (k) => DASHES[k % DASHES.length].split(" ").filter(Boolean).map(Number);
const varies = (values) => values.some((x) => x !== 0 && !Number.isNaN(x));

// [[column, ...], ...] of equal units, at most MOST_CURVES together.
function by_unit(columns) {
  const groups = new Map();
  for (const column of columns) {
    const key = column.unit || `alone ${column.name}`;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(column);
  }
  const parts = [];
  for (const group of groups.values())
    for (let k = 0; k < group.length; k += MOST_CURVES) parts.push(group.slice(k, k + MOST_CURVES));
  return parts;
}

function observed_plots(runs) {
  return by_unit(runs[0].series.observed()).map((columns) => ({
    title: columns.map((c) => c.name).join(", "), unit: columns[0].unit, curves: curves_of(runs, columns),
    note: columns.filter((c) => c.meaning).map((c) => `${c.name}: ${c.meaning}${c.path ? ` (${c.path})` : ""}`).join("; "),
  }));
}

// The same columns, less those of the first run, on its times.
function difference_plots(runs) {
  const [first, ...others] = runs;
  const minus = (run, name) => first.series.t.map((t, i) =>
    value_at(run.series.t, run.series.values(name), t) - first.series.values(name)[i]);
  return by_unit(first.series.observed()).map((columns) => ({
    title: `${columns.map((c) => c.name).join(", ")}: difference from ${first.name}`, unit: columns[0].unit,
    curves: others.flatMap((run, r) => columns.filter((c) => run.series.values(c.name)).map((column, c) => ({
      name: others.length === 1 ? column.name : `${column.name}, ${run.name}`, t: first.series.t,
      values: minus(run, column.name), colour: colour_of(columns.length === 1 ? r + 1 : c), dash: dash_numbers(r) }))),
    note: "Between two rows of a run its values are interpolated linearly.",
  })).filter((plot) => plot.curves.length > 0);
}

function energy_plots(runs) {
  const names = ["energy_kinetic", "energy_potential", "energy_elastic", "energy_total"];
  const columns = names.map((name) => ({ name })).filter(({ name }) => varies(runs[0].series.values(name) || []));
  const plots = [{ title: "Energy by kind", unit: "J", curves: curves_of(runs, columns) }];
  const balances = runs.map((run, r) => balance(run, r, runs.length > 1)).filter(Boolean);
  if (balances.length)
    plots.push({ title: "Energy that no cause explains", unit: "J", curves: balances,
      note: "E - (E at the start + supplied - dissipated): errors of the method, and energy of refinements." });
  return plots.filter((plot) => plot.curves.length > 0);
}

function balance(run, r, several) {
  const [total, supplied, lost] = ["energy_total", "energy_supplied", "energy_dissipated"].map((n) => run.series.values(n));
  if (!total || !supplied || run.series.interval > 1) return null; // reduced rows hold extremes from different times
  const values = total.map((e, i) => e - (total[0] + supplied[i] - lost[i]));
  return { name: several ? run.name : "balance", t: run.series.t, values, colour: colour_of(r), dash: [] };
}

function constraint_plots(runs) {
  const columns = ["position", "velocity", "acceleration"].map((level) => ({ name: `constraint_${level}` }))
    .filter(({ name }) => runs.some((run) => varies(run.series.values(name) || [])));
  if (columns.length === 0) return [];
  return [{ title: "Norms of the constraints", unit: "m, m/s, m/s²", logarithmic: true, curves: curves_of(runs, columns) }];
}

// The mean step between two records, from the count of steps.
function step_plots(runs) {
  const curves = runs.map((run, r) => {
    const { t } = run.series, steps = run.series.values("steps");
    if (!steps || steps.length < 2) return null;
    const times = [], values = [];
    for (let i = 1; i < t.length; ++i) {
      if (!(steps[i] > steps[i - 1])) continue;
      times.push(t[i]);
      values.push((t[i] - t[i - 1]) / (steps[i] - steps[i - 1]));
    }
    return { name: runs.length > 1 ? run.name : "step", t: Float64Array.from(times), values: Float64Array.from(values),
             colour: colour_of(r), dash: [] };
  }).filter((curve) => curve && curve.t.length > 1);
  if (curves.length === 0) return [];
  return [{ title: "Mean step size between records", unit: "s", logarithmic: true, curves }];
}

// Size of the force of each contact, 0 while it is open, from the frames of the animation.
function contact_plots(runs) {
  const curves = [];
  let left_out = 0;
  runs.forEach((run, r) => {
    const { animation } = run;
    if (!animation) return;
    const forces = animation.contact_names.map((name) => ({ name, values: new Float64Array(animation.frames) }));
    const of = new Map(forces.map((force) => [force.name, force.values]));
    animation.arrows.forEach((list, frame) => list.forEach(({ contact, force }) => {
      if (contact !== undefined) of.get(contact)[frame] = Math.hypot(...force);
    }));
    const most = (force) => force.values.reduce((a, b) => Math.max(a, b), 0);
    forces.sort((a, b) => most(b) - most(a));
    left_out += Math.max(0, forces.length - MOST_CONTACTS);
    forces.slice(0, MOST_CONTACTS).forEach(({ name, values }, c) => curves.push({ t: animation.t, values,
      name: runs.length > 1 ? `${name}, ${run.name}` : name, colour: colour_of(c), dash: runs.length > 1 ? dash_numbers(r) : [] }));
  });
  if (curves.length === 0) return [];
  const note = "At the frames of the animation, from the integrator's own multipliers; impacts are events." +
    (left_out ? ` Of ${left_out + MOST_CONTACTS} contacts those with the largest forces.` : "");
  return [{ title: "Contact forces", unit: "N", curves, note }];
}

const KIND_COLOURS = { impact: 1, contact_close: 2, contact_open: 4, latch: 3, lift: 4, stick: 0, slip: 5, reversal: 5, refine: 3 };

function event_marks(run) {
  return run.events.rows.map(([t, kind]) => ({ t, colour: colour_of(KIND_COLOURS[kind] ?? 6) })).sort((a, b) => a.t - b.t);
}

function plots_section(runs, clock) {
  const window_of_time = new TimeWindow(clock.begin, clock.end), marks = event_marks(runs[0]);
  const cards = (plots) => plots.map((plot) => new TimePlot(plot, clock, window_of_time, marks).root);
  const plots = element("div", { class: "columns" }, cards([...observed_plots(runs), ...energy_plots(runs),
    ...contact_plots(runs), ...constraint_plots(runs), ...step_plots(runs)]));
  const section = element("section", {}, differences_switch(runs, plots, cards), plots);
  section.time_window = window_of_time;
  return section;
}

function differences_switch(runs, place, cards) {
  if (runs.length < 2) return null;
  let differences = null;
  return element("p", { class: "switch" }, element("label", {}, element("input", { type: "checkbox", id: "differences",
    onchange: (event) => {
      if (!differences) place.before((differences = element("div", { class: "columns", id: "difference-plots" },
        cards(difference_plots(runs)))));
      differences.hidden = !event.target.checked;
    } }), ` Show differences from ${runs[0].name}`));
}
