// The stage with its controls: play, time, speed, what is shown, which body is followed.

class Player {
  constructor(stage, clock, facts) {
    this.stage = stage;
    this.clock = clock;
    this.playing = element("button", { type: "button", id: "play", class: "main", onclick: () => clock.play() }, "Play");
    this.time = element("input", { type: "range", id: "time", min: "0", max: "10000", step: "1", value: "0",
      "aria-label": "time", oninput: () => this.scrub() });
    this.reading = element("output", { id: "reading" });
    this.root = element("section", { class: "card player" }, stage.canvas,
      element("div", { class: "controls" }, this.playing, this.time, this.reading),
      element("div", { class: "controls" }, this.speeds(), this.bodies(), this.toggles(), this.view()),
      this.runs(), this.colours(), facts);
    clock.heard_by((t) => this.show(t));
    document.addEventListener("keydown", (event) => this.key(event));
  }

  show(t) {
    const { clock } = this;
    this.stage.draw(t);
    this.time.value = String(Math.round((10000 * (t - clock.begin)) / (clock.end - clock.begin)));
    this.time.setAttribute("aria-valuetext", `${number_text(t)} s`);
    this.reading.textContent = `t = ${number_text(t, 6)} s`;
    this.playing.textContent = clock.playing ? "Pause" : "Play";
  }

  scrub() {
    const { clock } = this;
    clock.play(false);
    clock.set(clock.begin + (clock.end - clock.begin) * (Number(this.time.value) / 10000));
  }

  // Keys that no other element uses: space plays, arrows go from frame to frame.
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("input, select, button, summary, svg, .scroll")) return;
    const { animation } = this.stage.actors[0], frame = animation.frame_at(this.clock.t);
    const goal = { ArrowRight: frame + 1, ArrowLeft: frame - 1, Home: 0, End: animation.frames - 1 }[event.key];
    if (event.key === " ") this.clock.play();
    else if (goal === undefined) return;
    else {
      this.clock.play(false);
      this.clock.set(animation.t[Math.max(0, Math.min(animation.frames - 1, goal))]);
    }
    event.preventDefault();
  }

  speeds() {
    const usual = this.clock.usual_speed();
    const speeds = [0.01, 0.1, 0.2, 0.5, 1, 2, 5, 10].map((factor) => Number((usual * factor).toPrecision(1)));
    const choices = [...new Set([...speeds, 1])].sort((a, b) => a - b);
    return element("label", {}, "Speed ", element("select", { id: "speed",
      onchange: (event) => (this.clock.speed = Number(event.target.value)) },
      choices.map((s) => element("option", { value: s, selected: s === usual }, s === 1 ? "real time" : `${number_text(s)} x`))));
  }

  bodies() {
    const { layouts } = this.stage.actors[0].animation;
    const names = layouts[0].bodies.map((body) => body.name);
    return element("label", {}, "Follow ", element("select", { id: "follow", onchange: (event) => {
      this.stage.follows = event.target.value || null;
      if (!this.stage.follows) this.stage.camera.reset();
      this.stage.draw();
    } }, element("option", { value: "" }, "nothing"), names.map((name) => element("option", { value: name }, name))));
  }

  toggles() {
    const { animation } = this.stage.actors[0], layout = animation.layouts[0];
    const offered = { forces: this.stage.largest > 0, joints: layout.joints.length > 0, mesh: layout.faces.length > 0 };
    return Object.keys(offered).filter((what) => offered[what]).map((what) => element("label", {},
      element("input", { type: "checkbox", id: `show-${what}`, checked: true, onchange: (event) => {
        this.stage.shows[what] = event.target.checked;
        this.stage.draw();
      } }), ` ${what}`));
  }

  view() {
    return element("button", { type: "button", id: "reset", onclick: () => this.stage.reset() }, "Reset view");
  }

  // Which of several runs are drawn.
  runs() {
    const { actors, hidden } = this.stage;
    if (actors.length < 2) return null;
    return element("ul", { class: "legend" }, actors.map((actor, k) => {
      const button = element("button", { type: "button", "aria-pressed": "true", onclick: () => {
        hidden.has(k) ? hidden.delete(k) : hidden.add(k);
        button.setAttribute("aria-pressed", String(!hidden.has(k)));
        this.stage.draw();
      } }, element("span", { class: "swatch", style: `background:${actor.tint}` }), actor.name);
      return element("li", {}, button);
    }));
  }

  // The scale of the faces' colours.
  colours() {
    const { animation, still } = this.stage.actors[0];
    const texts = Object.values(still.face_values || {});
    if (animation.values.length === 0) return null;
    const stops = Array.from({ length: 9 }, (_, k) => shade(k / 8, 1)).join(",");
    return element("div", { class: "colours" }, element("span", {}, texts[0] || "values"), number_text(animation.low_value, 3),
      element("span", { class: "bar", style: `background:linear-gradient(90deg,${stops})` }),
      animation.top_colour < 0.98 * animation.high_value
        ? `${number_text(animation.top_colour, 3)} and above, to ${number_text(animation.high_value, 3)}`
        : number_text(animation.high_value, 3));
  }
}
