// A plot over time by dygraphs: zoomed by a drag, moved with Shift, reset by a double click, always together with the
// other plots. A click sets the time of the animation. It shows least and largest values of each pixel column.

// The window of time that all plots show, and the plots themselves.
class TimeWindow {
  constructor(begin, end) {
    this.range = [begin, end];
    this.plots = [];
  }

  show(range, by) {
    this.range = range;
    for (const plot of this.plots) if (plot !== by) plot.follow(range);
  }
}

const plot_ticks = (ticks) => ticks.map(({ at, text }) => ({ v: at, label: text }));

class TimePlot {
  // curves: [{name, t, values, colour, dash}]; `marks`: [{t, colour}] of events.
  constructor({ title, unit, curves, logarithmic, note }, clock, window_of_time, marks) {
    Object.assign(this, { curves, clock, window_of_time, marks, logarithmic });
    this.shared = curves.every((c) => c.t === curves[0].t);
    this.place = element("div", { class: "time-plot", role: "img",
      "aria-label": `${title} over time: ${curves.map((c) => c.name).join(", ")}` });
    this.cursor = element("div", { class: "cursor" });
    this.values = curves.map(() => element("span", { class: "value" }));
    this.root = element("figure", { class: "card" },
      element("h2", {}, title, unit ? element("span", { class: "soft" }, ` [${unit}]`) : null),
      element("div", { class: "plot-box" }, this.place, this.cursor),
      element("ul", { class: "legend values" }, curves.map((curve, k) => this.legend_entry(curve, k))),
      note ? element("figcaption", {}, note) : null);
    at_its_width(this.place, () => (this.graph ? this.redraw() : this.draw()));
    clock.heard_by((t) => this.at(t));
  }

  legend_entry(curve, k) {
    const sample = drawn("svg", { width: 26, height: 10, "aria-hidden": "true" },
      drawn("path", { d: "M0,5H26", stroke: curve.colour, "stroke-width": 2.5, "stroke-dasharray": curve.dash.join(" ") }));
    const button = element("button", { type: "button", "aria-pressed": "true", onclick: () => {
      const shown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(shown));
      this.graph?.setVisibility(k, shown);
    } }, sample, curve.name, this.values[k]);
    return element("li", {}, button);
  }

  // One table for all curves. Curves with different times leave gaps in each other's columns; lines continue across them.
  rows([low, high]) {
    const pixels = Math.max(100, this.place.clientWidth);
    const positive = (rows) => {
      if (this.logarithmic) for (const row of rows) for (let k = 1; k < row.length; ++k) if (!(row[k] > 0)) row[k] = null;
      return rows;
    };
    if (this.shared) return positive(decimated(this.curves[0].t, this.curves.map((c) => c.values), low, high, pixels));
    const all = this.curves.flatMap((curve, k) => decimated(curve.t, [curve.values], low, high, pixels).map(([t, value]) => {
      const row = [t, ...this.curves.map(() => null)];
      row[k + 1] = value;
      return row;
    }));
    return positive(all.sort((a, b) => a[0] - b[0]));
  }

  draw() {
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue(name).trim();
    const [low, high] = this.window_of_time.range;
    this.graph = new Dygraph(this.place, this.rows([low, high]), {
      labels: ["t", ...this.curves.map((c, k) => `${k} ${c.name}`)],
      colors: this.curves.map((c) => c.colour),
      series: Object.fromEntries(this.curves.map((c, k) => [`${k} ${c.name}`, { strokePattern: c.dash.length ? c.dash : null }])),
      strokeWidth: 1.6, connectSeparatedPoints: !this.shared, legend: "never", logscale: !!this.logarithmic,
      dateWindow: [low, high], highlightCircleSize: 3, animatedZooms: false, yRangePad: 8, xRangePad: 0,
      gridLineColor: colour("--grid"), axisLineColor: colour("--rule"), gridLineWidth: 1, axisLabelFontSize: 12,
      axes: { x: { ticker: (a, b, pixels) => plot_ticks(linear_ticks(a, b, pixels / 80)) },
              y: { ticker: (a, b, pixels) => plot_ticks(this.y_ticks(a, b, pixels / 40)), axisLabelWidth: 62 } },
      valueRange: this.logarithmic ? this.wide_range() : null,
      underlayCallback: (context, area, graph) => this.draw_marks(context, area, graph),
      drawCallback: (graph, initial) => !initial && this.moved(graph),
      clickCallback: (_, t) => { this.clock.play(false); this.clock.set(t); },
    });
    this.window_of_time.plots.push(this);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    this.at(this.clock.t);
  }

  y_ticks(low, high, wanted) {
    return this.logarithmic ? logarithmic_ticks(low, high, Math.max(2, wanted)).filter((t) => t.text) : linear_ticks(low, high, wanted);
  }

  // The range of a logarithmic axis: at least a decade, so that small changes look small; null: the range of the values.
  wide_range() {
    let low = Infinity, high = 0;
    for (const { values } of this.curves)
      for (const x of values) if (x > 0 && x < Infinity) [low, high] = [Math.min(low, x), Math.max(high, x)];
    if (!(high > 0) || high / low > 10) return null;
    const middle = Math.sqrt(low * high);
    return [middle / 5, middle * 5];
  }

  recolour() {
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue(name).trim();
    this.graph.updateOptions({ gridLineColor: colour("--grid"), axisLineColor: colour("--rule") });
  }

  redraw() {
    this.graph.resize();
    this.follow(this.window_of_time.range);
  }

  // The reader zoomed or moved this plot.
  moved(graph) {
    const range = graph.xAxisRange(), [low, high] = this.window_of_time.range;
    if (this.following || (range[0] === low && range[1] === high)) return this.at(this.clock.t);
    this.window_of_time.show(range, this);
    this.follow(range);
  }

  follow(range) {
    this.following = true;
    this.graph.updateOptions({ file: this.rows(range), dateWindow: range });
    this.following = false;
    this.at(this.clock.t);
  }

  // Event marks: short strokes on the time axis, one a pixel.
  draw_marks(context, area, graph) {
    let last = -Infinity;
    for (const { t, colour } of this.marks) {
      const x = Math.round(graph.toDomXCoord(t));
      if (x <= last || x < area.x || x > area.x + area.w) continue;
      last = x;
      context.fillStyle = colour;
      context.globalAlpha = 0.8;
      context.fillRect(x, area.y + area.h - 7, 1.5, 7);
    }
    context.globalAlpha = 1;
  }

  // The time of the animation: a line, and the values there.
  at(t) {
    this.curves.forEach((curve, k) => (this.values[k].textContent = number_text(value_at(curve.t, curve.values, t), 5)));
    if (!this.graph) return;
    const area = this.graph.getArea(), x = this.graph.toDomXCoord(t);
    const inside = x >= area.x - 0.5 && x <= area.x + area.w + 0.5;
    this.cursor.style.display = inside ? "block" : "none";
    this.cursor.style.transform = `translateX(${x}px)`;
    this.cursor.style.height = `${area.h}px`;
  }
}
