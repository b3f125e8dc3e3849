// The report on a modal analysis: the frequencies as a table, and the shape of the chosen mode, moving.

// Frames of one period of a mode at some amplitude: at + a (re cos wt - im sin wt), as an Animation has them.
class ModeShape {
  constructor(shape, dimension) {
    this.bodies = shape.bodies;
    this.dimension = dimension;
    let points = 0;
    const bodies = shape.bodies.map((b) => ({ name: b.name, count: b.at.length, first: (points += b.at.length) - b.at.length }));
    this.layouts = [{ bodies, faces: [], joints: [], balls: [], points, values: 0 }];
    this.place = new Float32Array(3 * Math.max(1, points));
    this.value = this.values = [];
    this.arrows = [[]];
    this.t = [0, 1];
    this.frames = 2;
    this.amplitude = this.usual_amplitude();
  }

  each(visit) {
    let k = 0;
    for (const { at, re, im } of this.bodies) for (let j = 0; j < at.length; ++j) visit(at[j], re[j], im[j], k++);
  }

  // The largest displacement is a sixth of the mechanism's size.
  usual_amplitude() {
    let most = 0;
    this.each((at, re, im) => (most = Math.max(most, Math.hypot(...re, ...im))));
    return most > 0 ? this.size() / 6 / most : 1;
  }

  // The size of the mechanism at rest [m]; 1 for a single point, so that its motion is visible.
  size() {
    const [low, high] = this.still_box();
    return Math.max(...high.map((x, i) => x - low[i])) || 1;
  }

  still_box() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    this.each((at) => at.forEach((x, i) => {
      low[i] = Math.min(low[i], x);
      high[i] = Math.max(high[i], x);
    }));
    for (let i = 0; i < 3; ++i) if (low[i] > high[i]) low[i] = high[i] = 0;
    return [low, high];
  }

  box() {
    const [low, high] = this.still_box(), margin = this.size() / 6;
    const wide = (i) => (i < this.dimension ? margin : 0);
    return [low.map((x, i) => x - wide(i)), high.map((x, i) => x + wide(i))];
  }

  frame_at() {
    return 0;
  }

  largest_force() {
    return 0;
  }

  // t in periods.
  at(t) {
    const [c, s] = [Math.cos(2 * Math.PI * t), Math.sin(2 * Math.PI * t)].map((x) => this.amplitude * x);
    this.each((at, re, im, k) => {
      for (let i = 0; i < this.dimension; ++i) this.place[3 * k + i] = at[i] + re[i] * c - im[i] * s;
    });
    return { layout: this.layouts[0], frame: 0 };
  }
}

// The mechanism at rest, for comparison.
class AtRest extends ModeShape {
  at() {
    this.each((at, re, im, k) => {
      for (let i = 0; i < this.dimension; ++i) this.place[3 * k + i] = at[i];
    });
    return { layout: this.layouts[0], frame: 0 };
  }
}

function show_modes(data, root) {
  const { result, shapes, name } = data.modes;
  root.append(element("h1", {}, `Modes of ${result.title || name}`));
  root.append(element("p", {}, `Small motions about ${result.state}, t = ${number_text(result.t)} s. ` +
    (result.unstable ? `${plural(result.unstable, "mode")} grow.` : "No mode grows.")));
  for (const text of result.warnings || []) root.append(element("p", {}, `Note: ${text}`));
  const title = element("h2", {}), stages = element("div");
  let stage = null, playing = true;
  const choose = (k) => {
    const mode = result.modes[k], shape = shapes.find((s) => s.mode === mode.mode);
    title.textContent = `Mode ${mode.mode}: ${number_text(mode.frequency_hz, 6)} Hz, damping ratio ${number_text(mode.damping_ratio, 4)}`;
    if (!shape) return stages.replaceChildren(element("p", { class: "soft" }, "No body of this scene is drawn."));
    const dimension = shape.bodies[0].at[0].length, camera = stage && stage.camera;
    const rest = new AtRest(shape, dimension), moves = new ModeShape(shape, dimension);
    stage = new Stage([{ animation: moves, still: {}, tint: colour_of(0), name: "mode" },
      { animation: rest, still: {}, tint: colour_of(6), name: "at rest" }]);
    if (camera) Object.assign(stage.camera, { zoom: camera.zoom, yaw: camera.yaw, tilt: camera.tilt });
    stages.replaceChildren(stage.canvas);
    window.trammel_report = { stage };
  };
  const button = element("button", { type: "button", id: "play", class: "main", onclick: () => {
    playing = !playing;
    button.textContent = playing ? "Pause" : "Play";
  } }, "Pause");
  const amplitude = element("input", { type: "range", min: "0", max: "300", value: "100", "aria-label": "amplitude",
    oninput: () => {
      const [moves] = stage.actors;
      moves.animation.amplitude = moves.animation.usual_amplitude() * (Number(amplitude.value) / 100);
      stage.draw();
    } });
  root.append(element("section", { class: "card player" }, title, stages,
    element("div", { class: "controls" }, button, element("label", {}, "Amplitude ", amplitude))));
  const columns = [{ name: "mode" }, { name: "kind" }, { name: "frequency", unit: "Hz" }, { name: "frequency", unit: "rad/s" },
    { name: "damping ratio" }, { name: "growth", unit: "1/s" }];
  const rows = result.modes.map((m) => [String(m.mode), m.kind, number_text(m.frequency_hz, 7), number_text(m.frequency_rad_s, 7),
    number_text(m.damping_ratio, 5), number_text(m.eigenvalue.real, 5)]);
  root.append(element("section", { class: "card", id: "modes" }, element("h2", {}, "Modes"),
    element("p", { class: "soft" }, "A row shows its mode."), table_element(columns, rows, choose)));
  if (result.modes.length === 0) return;
  choose(0);
  const begin = performance.now();
  let paused = 0, last = begin;
  const tick = (now) => {
    if (!playing) paused += now - last;
    last = now;
    if (stage && playing) stage.draw((now - begin - paused) / 2000);
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}
