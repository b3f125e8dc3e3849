// The canvas with the mechanisms of all runs: what is drawn at a time, and how the reader moves the view. A drag moves
// (planar) or orbits (spatial), with Shift it moves; wheel and two fingers zoom.

class Stage {
  // actors: [{animation, still, tint, name}]
  constructor(actors) {
    this.actors = actors;
    this.hidden = new Set();
    const dimension = actors[0].animation.dimension;
    this.camera = new Camera(dimension, this.common_box());
    this.canvas = element("canvas", { class: "stage", tabindex: "0", role: "img",
      "aria-label": "The mechanism. Drag to " + (dimension === 3 ? "orbit" : "move") + ", plus and minus zoom, 0 resets." });
    this.painter = new Painter(this.canvas, this.camera);
    this.shows = { forces: true, joints: true, mesh: true };
    this.follows = null;
    this.largest = Math.max(...actors.map((a) => a.animation.largest_force()));
    this.t = actors[0].animation.t[0];
    this.listen();
    at_its_width(this.canvas, () => this.draw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  common_box() {
    const boxes = this.actors.map((a) => a.animation.box());
    const low = [0, 1, 2].map((i) => Math.min(...boxes.map((b) => b[0][i])));
    const high = [0, 1, 2].map((i) => Math.max(...boxes.map((b) => b[1][i])));
    const radii = Math.max(0, ...this.actors.flatMap((a) => Object.values(a.still.balls || {})));
    return [low.map((x, i) => (i < 2 || high[i] > x ? x - radii : x)), high.map((x, i) => (i < 2 || x > low[i] ? x + radii : x))];
  }

  draw(t = this.t) {
    this.t = t;
    const begin = performance.now(), { painter } = this;
    if (this.canvas.clientWidth === 0) return;
    if (this.follows) this.centre_on(this.follows, t);
    painter.begin();
    painter.meshed = this.shows.mesh;
    painter.planes(this.actors[0].still.planes);
    const shown = this.actors.filter((_, k) => !this.hidden.has(k));
    for (const actor of shown) {
      const faint = this.actors.length > 1 && actor !== shown[0];
      const { layout, frame } = painter.mechanism(actor.animation, actor.still, t, actor.tint, faint);
      if (this.shows.joints && layout.joints.length <= 60) painter.joints(layout);
      if (this.shows.forces && this.largest > 0)
        painter.arrows(actor.animation.arrows[frame], this.largest, 0.22 * Math.min(painter.width, painter.height));
    }
    painter.scale_bar();
    this.draw_time = performance.now() - begin; // [ms]
  }

  centre_on(name, t) {
    const { animation } = this.actors[0], { layout } = animation.at(t);
    const body = layout.bodies.find((b) => b.name === name);
    if (!body) return;
    for (let i = 0; i < 3; ++i) {
      let sum = 0;
      for (let k = body.first; k < body.first + body.count; ++k) sum += animation.place[3 * k + i];
      this.camera.centre[i] = sum / body.count;
    }
  }

  listen() {
    const fingers = new Map(), { canvas, camera } = this;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    });
    for (const end of ["pointerup", "pointercancel"])
      canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      const was = fingers.get(event.pointerId);
      if (!was) return;
      const is = [event.offsetX, event.offsetY], other = [...fingers.entries()].find(([id]) => id !== event.pointerId);
      fingers.set(event.pointerId, is);
      if (other) {
        const apart = (p) => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]);
        camera.zoom_by(apart(is) / (apart(was) || 1), (is[0] + other[1][0]) / 2, (is[1] + other[1][1]) / 2);
      } else {
        camera.spatial && !event.shiftKey ? camera.orbit(is[0] - was[0], is[1] - was[1]) : camera.pan(is[0] - was[0], is[1] - was[1]);
      }
      this.draw();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      camera.zoom_by(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
      this.draw();
    }, { passive: false });
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const { camera } = this, middle = [this.painter.width / 2, this.painter.height / 2];
    if (event.key === "+" || event.key === "=") camera.zoom_by(1.2, ...middle);
    else if (event.key === "-") camera.zoom_by(1 / 1.2, ...middle);
    else if (event.key === "0") camera.reset();
    else return;
    event.preventDefault();
    this.draw();
  }

  reset() {
    this.camera.reset();
    this.draw();
  }
}
