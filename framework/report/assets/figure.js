// A figure of a page: curves and points over linear or logarithmic axes, as SVG. The point nearest to the pointer, or
// the one reached by the arrow keys, shows its note. Runs without a y are drawn as crosses in a strip above the plot.

const STRIP = 22; // height for failures [px]

// Curves as {name, mark, points: [{x, y, note, failed}]}; a point without a y that the axis can show is a failure.
function read_curves(figure) {
  const logarithmic = figure.y.scale === "logarithmic";
  return figure.curves.map((curve) => {
    const point = ([x, y, note], failed) => ({ x, y, note: note || "", failed });
    const shown = curve.points.map((p) => point(p, false));
    for (const p of shown)
      if (!Number.isFinite(p.y)) p.failed = true;
      else if (logarithmic && p.y <= 0) {
        p.failed = true;
        p.note += `${p.note ? "; " : ""}y = ${number_text(p.y)}, which a logarithmic axis cannot show`;
      }
    return { name: curve.name, mark: curve.mark, points: shown.concat(curve.failures.map((p) => point(p, true))) };
  });
}

class Figure {
  constructor(figure) {
    this.figure = figure;
    this.curves = read_curves(figure);
    this.hidden = new Set();
    this.reached = -1; // by the keys, in `this.spots`
    this.place = element("div");
    this.note = element("div", { class: "note", role: "status", hidden: true });
    this.legend = element("ul", { class: "legend" }, this.curves.map((curve, k) => this.legend_entry(curve, k)));
    this.root = element("figure", { class: "card" }, element("h2", {}, figure.title), this.place, this.note,
      this.curves.length > 1 || this.failures() > 0 ? this.legend : null,
      element("figcaption", {}, figure.caption, this.failures() ? ` ${this.failure_text()}` : ""));
    at_its_width(this.place, (width) => this.draw(width));
  }

  failures() {
    return this.curves.reduce((sum, curve) => sum + curve.points.filter((p) => p.failed).length, 0);
  }

  failure_text() {
    return `Crosses above the plot: ${plural(this.failures(), "run")} without a value there.`;
  }

  legend_entry(curve, k) {
    const sample = drawn("svg", { width: 30, height: 12, "aria-hidden": "true" },
      curve.mark === "points" ? null : drawn("path", { d: "M0,6H30", stroke: colour_of(k), "stroke-width": 2,
        "stroke-dasharray": curve.mark === "dashed" ? "6 4" : dash_of(k) }),
      curve.mark === "line" || curve.mark === "dashed" ? null : mark_element(k, 15, 6, 4.5));
    const button = element("button", { type: "button", "aria-pressed": "true", onclick: () => {
      this.hidden.has(k) ? this.hidden.delete(k) : this.hidden.add(k);
      button.setAttribute("aria-pressed", String(!this.hidden.has(k)));
      this.draw(this.width);
    } }, sample, curve.name);
    return element("li", {}, button);
  }

  visible() {
    return this.curves.map((curve, k) => ({ ...curve, k })).filter((curve) => !this.hidden.has(curve.k));
  }

  draw(width) {
    this.width = width;
    const height = Math.round(Math.min(420, Math.max(260, width * 0.62)));
    const strip = this.failures() > 0 ? STRIP : 0;
    const box = { left: 64, right: width - 12, top: 8 + strip, bottom: height - 46 };
    const points = this.visible().flatMap((curve) => curve.points);
    const { x, y } = this.figure;
    const logarithmic = (a) => a.scale === "logarithmic";
    this.x = axis(points.map((p) => p.x), logarithmic(x), box.left, box.right, Math.max(3, (box.right - box.left) / 80));
    this.y = axis(points.filter((p) => !p.failed).map((p) => p.y), logarithmic(y), box.bottom, box.top,
      (box.bottom - box.top) / 40);
    this.spots = [];
    const svg = drawn("svg", { class: "plot", viewBox: `0 0 ${width} ${height}`, height, tabindex: "0", role: "img",
      "aria-label": `${this.figure.title}. ${y.label} over ${x.label}. Arrow keys step through the points.` },
      this.grid(box), this.labels(box, width, height), this.visible().map((curve) => this.curve(curve, box)));
    svg.addEventListener("pointermove", (event) => this.point_at(event, svg));
    svg.addEventListener("pointerleave", () => this.show(null));
    svg.addEventListener("keydown", (event) => this.key(event));
    svg.addEventListener("blur", () => this.show(null));
    this.ring = drawn("circle", { r: 8, fill: "none", stroke: "currentColor", "stroke-width": 1.5, visibility: "hidden" });
    svg.append(this.ring);
    this.place.replaceChildren(svg);
  }

  grid(box) {
    const lines = [];
    for (const { at, text } of this.x.ticks)
      lines.push(drawn("line", { class: text ? "gridline" : "gridline minor", x1: this.x.place(at), x2: this.x.place(at),
        y1: box.top, y2: box.bottom }));
    for (const { at, text } of this.y.ticks)
      lines.push(drawn("line", { class: text ? "gridline" : "gridline minor", x1: box.left, x2: box.right,
        y1: this.y.place(at), y2: this.y.place(at) }));
    lines.push(drawn("rect", { class: "frame", x: box.left, y: box.top, width: box.right - box.left,
      height: box.bottom - box.top }));
    return lines;
  }

  labels(box, width, height) {
    const { x, y } = this.figure;
    const middle = (box.top + box.bottom) / 2;
    return [
      this.x.ticks.filter((t) => t.text).map((t) => drawn("text", { x: this.x.place(t.at), y: box.bottom + 17,
        "text-anchor": "middle" }, t.text)),
      this.y.ticks.filter((t) => t.text).map((t) => drawn("text", { x: box.left - 6, y: this.y.place(t.at) + 4,
        "text-anchor": "end" }, t.text)),
      drawn("text", { class: "axis-label", x: (box.left + box.right) / 2, y: height - 8, "text-anchor": "middle" }, x.label),
      drawn("text", { class: "axis-label", x: 13, y: middle, "text-anchor": "middle",
        transform: `rotate(-90 13 ${middle})` }, y.label),
    ];
  }

  curve(curve, box) {
    const shown = curve.points.filter((p) => !p.failed && this.x.shows(p.x));
    const at = (p) => [this.x.place(p.x), this.y.place(p.y)];
    const parts = [];
    if (curve.mark !== "points" && shown.length > 1)
      parts.push(drawn("path", { d: "M" + shown.map((p) => at(p).map((c) => c.toFixed(1)).join(",")).join("L"),
        fill: "none", stroke: colour_of(curve.k), "stroke-width": curve.mark === "dashed" ? 1.5 : 2,
        "stroke-linejoin": "round", "stroke-dasharray": curve.mark === "dashed" ? "6 4" : dash_of(curve.k) }));
    for (const p of shown) {
      const [px, py] = at(p);
      this.spots.push({ curve, point: p, x: px, y: py });
      if (curve.mark === "points" || curve.mark === "line and points") parts.push(mark_element(curve.k, px, py));
    }
    for (const p of curve.points.filter((q) => q.failed && this.x.shows(q.x))) {
      const px = this.x.place(p.x), py = box.top - STRIP / 2 - 1;
      this.spots.push({ curve, point: p, x: px, y: py });
      parts.push(drawn("path", { d: mark_path("cross", px, py, 5), stroke: colour_of(curve.k), "stroke-width": 2.5 }));
    }
    return parts;
  }

  point_at(event, svg) {
    const bounds = svg.getBoundingClientRect(), scale = this.width / bounds.width;
    const x = (event.clientX - bounds.left) * scale, y = (event.clientY - bounds.top) * scale;
    let nearest = null, distance = 28;
    for (const spot of this.spots) {
      const d = Math.hypot(spot.x - x, spot.y - y);
      if (d < distance) [nearest, distance] = [spot, d];
    }
    this.show(nearest);
  }

  key(event) {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (event.key === "Escape") this.show(null);
    if (!step || this.spots.length === 0) return;
    event.preventDefault();
    this.reached = (this.reached + step + this.spots.length) % this.spots.length;
    this.show(this.spots[this.reached]);
  }

  show(spot) {
    this.note.hidden = !spot;
    this.ring.setAttribute("visibility", spot ? "visible" : "hidden");
    if (!spot) return;
    this.ring.setAttribute("cx", spot.x);
    this.ring.setAttribute("cy", spot.y);
    const { x, y } = this.figure, p = spot.point;
    const value = p.failed ? "no value" : `${y.label}: ${number_text(p.y)}`;
    this.note.replaceChildren(element("strong", {}, spot.curve.name), element("br"), `${x.label}: ${number_text(p.x)}`,
      element("br"), value, p.note ? [element("br"), p.note] : null);
    const top = this.place.offsetTop + spot.y, left = this.place.offsetLeft + spot.x;
    this.note.style.top = `${top + 14}px`;
    this.note.style.left = `${Math.max(0, Math.min(left + 10, this.root.clientWidth - this.note.offsetWidth - 8))}px`;
  }
}
