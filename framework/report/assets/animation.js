// The frames of a run's animation, decoded once. Between two frames of the same layout places are interpolated.

class Animation {
  constructor(data) {
    Object.assign(this, { dimension: data.dimension, frames: data.frames, total: data.total, stride: data.stride });
    this.t = f64_of(data.times);
    this.low = data.low;
    this.step = data.step;
    this.points = u16_of(data.points);
    this.values = u16_of(data.values);
    this.low_value = data.low_value;
    this.high_value = data.high_value;
    this.top_colour = this.value_exceeded_by(0.01);
    this.contact_names = data.contacts;
    this.force_names = data.forces;
    this.layouts = data.layouts.map((layout) => this.with_sizes(layout));
    this.find_frames();
    this.read_arrows(data.arrows);
    this.place = new Float32Array(3 * Math.max(...this.layouts.map((l) => l.points)));
    this.value = new Float32Array(Math.max(1, ...this.layouts.map((l) => l.values)));
  }

  // The value that the fraction `part` of all values exceeds: as the end of the colour scale it leaves out a few peaks.
  value_exceeded_by(part) {
    const sample = [], stride = Math.max(1, Math.floor(this.values.length / 20000));
    for (let k = 0; k < this.values.length; k += stride) sample.push(this.values[k]);
    sample.sort((a, b) => a - b);
    const value = sample[Math.floor((1 - part) * (sample.length - 1))] || 65535;
    return this.low_value + (value / 65535) * (this.high_value - this.low_value);
  }

  with_sizes(layout) {
    let points = 0, values = 0;
    const take = (n) => ((points += n), points - n);
    const bodies = layout.bodies.map((b) => ({ name: b.name, count: b.points, first: take(b.points) }));
    const faces = layout.faces.map((f) => {
      const face = { name: f.name, count: f.points, first: take(f.points), first_value: values, quads: u32_of(f.quads) };
      values += f.points;
      return face;
    });
    const names = (list) => list.map((name) => ({ name, first: take(1) }));
    const joints = names(layout.joints), balls = names(layout.balls);
    return { begin: layout.first, bodies, faces, joints, balls, points, values };
  }

  // Where each frame begins in the arrays, and its layout.
  find_frames() {
    this.layout_of = [];
    this.first_point = [];
    this.first_value = [];
    let point = 0, value = 0, k = 0;
    for (let frame = 0; frame < this.frames; ++frame) {
      while (k + 1 < this.layouts.length && this.layouts[k + 1].begin <= frame) ++k;
      this.layout_of.push(this.layouts[k]);
      this.first_point.push(point);
      this.first_value.push(value);
      point += this.layouts[k].points * this.dimension;
      value += this.layouts[k].values;
    }
    if (point !== this.points.length || value !== this.values.length)
      throw new Error(`the animation holds ${this.points.length} coordinates, and its layouts ${point}`);
  }

  // Per frame a list of {contact or force: name, at, force, from}.
  read_arrows(data) {
    const counts = u16_of(data.counts), numbers = f32_of(data.data), d = this.dimension;
    let at = 0;
    const vector = () => ((at += d), Array.from(numbers.subarray(at - d, at)));
    this.arrows = Array.from(counts, (count) => {
      const list = [];
      for (let k = 0; k < count; ++k) {
        const name = numbers[at++];
        list.push(name >= 0
          ? { contact: this.contact_names[name], at: vector(), force: vector() }
          : { spring: this.force_names[-1 - name], from: vector(), at: vector(), force: vector() });
      }
      return list;
    });
  }

  frame_at(t) {
    return Math.max(0, Math.min(this.frames - 1, first_from(this.t, t + 1e-12 * Math.abs(t)) - (this.t[0] >= t ? 0 : 1)));
  }

  // Fills `place` (3 numbers a point) and `value`; returns the layout and the frame at or before t.
  at(t) {
    const frame = this.frame_at(t), layout = this.layout_of[frame];
    const next = Math.min(frame + 1, this.frames - 1), same = this.layout_of[next] === layout && next > frame;
    const part = same ? Math.min(1, Math.max(0, (t - this.t[frame]) / (this.t[next] - this.t[frame] || 1))) : 0;
    const d = this.dimension, a = this.first_point[frame], b = same ? this.first_point[next] : a;
    for (let k = 0; k < layout.points; ++k)
      for (let i = 0; i < d; ++i) {
        const from = this.points[a + k * d + i], to = this.points[b + k * d + i];
        this.place[3 * k + i] = this.low[i] + (from + part * (to - from)) * this.step;
      }
    const scale = (this.high_value - this.low_value) / 65535;
    const va = this.first_value[frame], vb = same ? this.first_value[next] : va;
    for (let k = 0; k < layout.values; ++k)
      this.value[k] = this.low_value + (this.values[va + k] + part * (this.values[vb + k] - this.values[va + k])) * scale;
    return { layout, frame };
  }

  // The box of all frames: [[low], [high]].
  box() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], d = this.dimension;
    for (let k = 0; k < this.points.length; ++k) {
      const x = this.low[k % d] + this.points[k] * this.step;
      if (x < low[k % d]) low[k % d] = x;
      if (x > high[k % d]) high[k % d] = x;
    }
    for (let i = 0; i < 3; ++i) if (low[i] > high[i]) low[i] = high[i] = 0;
    return [low, high];
  }

  largest_force() {
    let largest = 0;
    for (const list of this.arrows) for (const arrow of list) largest = Math.max(largest, Math.hypot(...arrow.force));
    return largest;
  }
}
