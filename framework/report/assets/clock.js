// The time that the animation and the plots show.

class Clock {
  constructor(begin, end) {
    this.begin = begin;
    this.end = end > begin ? end : begin + 1;
    this.t = begin;
    this.playing = false;
    this.speed = this.usual_speed();
    this.listeners = [];
  }

  // The speed at which the whole run takes about ten seconds: 1, 2 or 5 times a power of ten.
  usual_speed() {
    const rough = (this.end - this.begin) / 10, power = 10 ** Math.floor(Math.log10(rough));
    return Number((power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999)).toPrecision(1));
  }

  heard_by(listener) {
    this.listeners.push(listener);
    listener(this.t);
  }

  set(t) {
    this.t = Math.max(this.begin, Math.min(this.end, t));
    for (const listener of this.listeners) listener(this.t);
  }

  play(on = !this.playing) {
    if (on === this.playing) return;
    this.playing = on;
    if (!on) return this.set(this.t);
    if (this.t >= this.end) this.t = this.begin;
    let last = null;
    const tick = (now) => {
      if (!this.playing) return;
      const passed = last === null ? 0 : Math.min(0.1, (now - last) / 1000);
      last = now;
      const t = this.t + passed * this.speed;
      if (t >= this.end) this.playing = false;
      this.set(t);
      if (this.playing) requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}
