// What a run was: the scene, how it was computed, its balance and its cost, as tables.

const facts_table = (rows) => element("table", { class: "facts" }, element("tbody", {}, rows.filter(Boolean)
  .map(([name, text]) => element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, text)))));

const fold = (title, content) => element("details", {}, element("summary", {}, title), content);

function status_line(run) {
  const { result } = run;
  if (!result.status) return null;
  if (result.status === "done") return null;
  return element("p", { class: "bad" }, `${run.label(result.status === "failed" ? "The run failed" : "The run was interrupted")}: ${result.reason}`);
}

const warnings_of = (run) => (run.result.warnings || []).concat(run.missing).map((text) => element("p", {}, `Note: ${text}`));

function count_by_type(group) {
  const counts = new Map();
  for (const part of Object.values(group || {})) counts.set(part.type || "?", (counts.get(part.type || "?") || 0) + 1);
  return [...counts].map(([type, n]) => (n > 1 ? `${n} x ${type}` : type)).join(", ");
}

function scene_rows(run) {
  const { result } = run;
  let scene = {};
  try {
    scene = JSON.parse(run.scene || "{}");
  } catch {
    /* shown as text below */
  }
  const sizes = Array.isArray(result.sizes) ? result.sizes[result.sizes.length - 1] : result.sizes;
  return [
    ["scene", result.scene || run.name],
    scene.space && ["space", `${scene.space}, gravity ${JSON.stringify(scene.gravity ?? [])} m/s²`],
    sizes && ["size", `${sizes.nq} coordinates, ${sizes.nv} velocities, ${sizes.nc} rows${result.sizes.length > 1 ? " at the end" : ""}`],
    ...["bodies", "joints", "forces", "contacts"].map((group) => {
      const text = count_by_type(scene[group]);
      return text && [group, text];
    }),
    Object.keys(scene.parameters || {}).length > 0 && ["parameters", Object.entries(scene.parameters)
      .filter(([, value]) => typeof value !== "object").map(([name, value]) => `${name} = ${value}`).join(", ")],
  ];
}

function method_rows(run) {
  const { result } = run, { made = {}, versions = {}, counts = {} } = result;
  return [
    result.integrator && ["integrator", `${result.integrator}${result.integrator_choice ? `: ${result.integrator_choice}` : ""}`],
    ["time", `${number_text(result.t_start)} to ${number_text(result.t_end)} s`],
    counts.steps !== undefined && ["steps", `${plural(counts.steps, "step")}, ${number_text(result.smallest_step)} to ${number_text(result.largest_step)} s; ${count_text(counts.rejected)} rejected, ${count_text(counts.locating_steps)} to locate events`],
    made.command && ["command", element("code", {}, [].concat(made.command).join(" "))],
    made.date && ["date", made.date],
    ["program", [versions.trammel, made.program?.version, made.program?.commit].filter(Boolean).join(", commit ")],
    result.scene_hash && ["scene hash", result.scene_hash],
  ];
}

function balance_rows(run) {
  const { energy_start, energy_end, energy_supplied, energy_dissipated: lost } = run.result;
  if (!lost) return [];
  const joule = (x) => `${number_text(x, 6)} J`;
  return [
    ["at the start", joule(energy_start)], ["at the end", joule(energy_end.total)], ["supplied", joule(energy_supplied.total)],
    ["lost to impacts", joule(lost.impact_total)], ["to contact damping", joule(lost.contact_damping)],
    ["to friction", joule(lost.friction_total)], ["to dampers", joule(lost.dampers)],
    ["to numerical errors", joule(lost.numerical)],
  ];
}

function cost_rows(run) {
  const { result } = run, { counts = {} } = result;
  const names = { residual_evaluations: "evaluations of f", jacobian_evaluations: "iteration matrices",
    factorizations: "factorisations", newton_iterations: "Newton iterations" };
  return [
    ["CPU time", `${number_text(result.cpu_time_s, 4)} s`], ["wall-clock time", `${number_text(result.wall_time_s, 4)} s`],
    ...Object.entries(names).filter(([key]) => counts[key] !== undefined).map(([key, text]) => [text, count_text(counts[key])]),
  ];
}

// Time of one evaluation of each kind of component, the largest first.
function component_table(run) {
  const costs = run.result.cost_by_component || [];
  if (costs.length === 0) return null;
  const sum = costs.reduce((total, c) => total + c.microseconds, 0) || 1;
  return [element("h3", {}, "By component, at the last state"),
    table_element([{ name: "component" }, { name: "count" }, { name: "once", unit: "µs" }, { name: "share" }],
      costs.map((c) => [`${c.component} (${c.kind})`, count_text(c.count), number_text(c.microseconds, 3),
        `${Math.round((100 * c.microseconds) / sum)} %`])),
    element("p", { class: "soft" }, "Time of all components of a kind for one evaluation of the equations.")];
}

function facts_section(run) {
  const card = (title, ...content) => element("section", { class: "card" }, element("h2", {}, run.label(title)), content);
  return element("div", { class: "columns" },
    card("What was simulated", facts_table(scene_rows(run)), run.scene ? fold("The scene as one file",
      element("pre", { class: "scroll", tabindex: "0" }, run.scene)) : null),
    card("How it was computed", facts_table(method_rows(run)), fold("result.json",
      element("pre", { class: "scroll", tabindex: "0" }, JSON.stringify(run.result, null, 1)))),
    balance_rows(run).length ? card("Energy", facts_table(balance_rows(run))) : null,
    card("Cost", facts_table(cost_rows(run)), component_table(run)));
}
