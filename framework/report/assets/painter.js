// Draws a mechanism on a canvas in painter's order: what is farther away first.

// Viridis at nine places (van der Walt, Smith 2015): even in brightness, so that it reads without colours, too.
const VIRIDIS = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99],
                 [170, 220, 50], [253, 231, 37]];

// Colours for a part in [0, 1] and a brightness in [0, 1], as style texts made once.
const shades = new Map();
function shade(part, light) {
  const p = Math.max(0, Math.min(63, Math.round(part * 63))), l = Math.max(0, Math.min(15, Math.round(light * 15)));
  const key = p * 16 + l;
  if (!shades.has(key)) {
    const at = (p / 63) * (VIRIDIS.length - 1), i = Math.min(VIRIDIS.length - 2, Math.floor(at)), f = at - i;
    const b = 0.55 + 0.45 * (l / 15);
    shades.set(key, `rgb(${VIRIDIS[i].map((c, k) => Math.round(b * (c + f * (VIRIDIS[i + 1][k] - c)))).join(",")})`);
  }
  return shades.get(key);
}

// A star of lines from one point, as rigid bodies draw their markers: every other point is the first.
function is_star(place, first, count) {
  if (count < 7 || count % 2 === 0) return false;
  for (let k = 2; k < count; k += 2)
    for (let i = 0; i < 3; ++i) if (Math.abs(place[3 * (first + k) + i] - place[3 * first + i]) > 1e-3) return false;
  return true;
}

// The convex hull of points given as [x, y] pairs in a flat array (Andrew's monotone chain).
function hull(points) {
  const order = [];
  for (let k = 0; k < points.length; k += 2) order.push([points[k], points[k + 1]]);
  order.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1) {
        const [a, b] = [chain[chain.length - 2], chain[chain.length - 1]];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return half(order).concat(half(order.reverse()));
}

class Painter {
  constructor(canvas, camera) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.camera = camera;
    this.read_colours();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.read_colours());
  }

  read_colours() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    this.ink = colour("--ink");
    this.soft = colour("--soft");
    this.rule = colour("--rule");
    this.card = colour("--card");
  }

  begin() {
    const { clientWidth: width, clientHeight: height } = this.canvas, ratio = Math.min(2, devicePixelRatio || 1);
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.camera.aim(width, height);
    this.width = width;
    this.height = height;
  }

  // Half spaces that contacts touch: a hatched line in the plane, a lattice in space.
  planes(planes) {
    const c = this.context, camera = this.camera;
    c.strokeStyle = this.soft;
    c.lineWidth = 1;
    for (const { point, normal } of planes || []) camera.spatial ? this.lattice(point, normal) : this.hatched(point, normal);
  }

  hatched(point, normal) {
    const c = this.context, [x, y] = this.camera.point(point), [nx, ny] = [normal[0], -normal[1]];
    const reach = 2 * Math.hypot(this.width, this.height), [tx, ty] = [-ny, nx];
    const near = (this.width / 2 - x) * tx + (this.height / 2 - y) * ty; // the middle of the picture along the line
    const line = (s, d) => [x + tx * s - nx * d, y + ty * s - ny * d];
    c.beginPath();
    c.moveTo(...line(near - reach, 0));
    c.lineTo(...line(near + reach, 0));
    c.globalAlpha = 0.9;
    c.stroke();
    c.beginPath();
    const begin = Math.ceil((near - reach) / 12) * 12;
    for (let s = begin; s < near + reach; s += 12) {
      c.moveTo(...line(s, 0));
      c.lineTo(...line(s - 7, 9));
    }
    c.globalAlpha = 0.4;
    c.stroke();
    c.globalAlpha = 1;
  }

  lattice(point, normal) {
    const c = this.context, [low, high] = this.camera.box;
    const size = Math.max(...low.map((x, i) => high[i] - x)) || 1;
    const n = Math.abs(normal[2]) > 0.9 ? [1, 0, 0] : [0, 0, 1];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const unit = (a) => a.map((x) => x / Math.hypot(...a));
    const u = unit(cross(n, normal)), v = cross(normal, u);
    const middle = low.map((x, i) => (x + high[i]) / 2);
    const above = normal.reduce((sum, x, i) => sum + x * (middle[i] - point[i]), 0);
    const origin = middle.map((x, i) => x - above * normal[i]); // below the middle of all frames
    const at = (a, b) => this.camera.point(origin.map((x, i) => x + size * (a * u[i] + b * v[i])));
    c.globalAlpha = 0.35;
    c.beginPath();
    for (let k = -6; k <= 6; ++k)
      for (const [from, to] of [[at(k / 8, -0.75), at(k / 8, 0.75)], [at(-0.75, k / 8), at(0.75, k / 8)]]) {
        c.moveTo(from[0], from[1]);
        c.lineTo(to[0], to[1]);
      }
    c.stroke();
    c.globalAlpha = 1;
  }

  // Bodies and faces of one run at time t. `tint`: the colour of the run's lines.
  mechanism(animation, still, t, tint, faint) {
    const { layout, frame } = animation.at(t), { place } = animation;
    if (!this.seen || this.seen.length < place.length) this.seen = new Float32Array(place.length);
    for (let k = 0; k < layout.points; ++k) this.camera.project(place, k, this.seen, k);
    const faced = new Set(layout.faces.map((face) => face.name));
    const parts = [];
    for (const body of layout.bodies) if (!faced.has(body.name)) parts.push(this.body_part(body, place));
    for (const ball of layout.balls) parts.push(this.ball_part(ball, (still.balls || {})[ball.name]));
    for (const face of layout.faces) this.add_quads(face, animation, parts);
    if (this.camera.spatial) parts.sort((a, b) => b.depth - a.depth);
    this.context.globalAlpha = faint ? 0.45 : 1;
    for (const part of parts) part.quad === undefined ? part.draw(tint) : this.quad(part, faint ? tint : null);
    this.context.globalAlpha = 1;
    return { layout, frame };
  }

  depth(first, count) {
    let sum = 0;
    for (let k = first; k < first + count; ++k) sum += this.seen[3 * k + 2];
    return sum / count;
  }

  body_part({ first, count }, place) {
    const star = is_star(place, first, count);
    const draw = count === 1 ? (tint) => this.disc(first, 5, tint)
      : star ? (tint) => this.star(first, count, tint) : (tint) => this.line(first, count, tint);
    return { depth: this.depth(first, count), draw };
  }

  disc(k, radius, tint, filled = true) {
    const c = this.context;
    c.beginPath();
    c.arc(this.seen[3 * k], this.seen[3 * k + 1], radius, 0, 2 * Math.PI);
    c.fillStyle = c.strokeStyle = tint;
    c.lineWidth = 1.5;
    filled ? c.fill() : c.stroke();
  }

  line(first, count, tint) {
    const c = this.context, { seen } = this;
    c.beginPath();
    c.moveTo(seen[3 * first], seen[3 * first + 1]);
    for (let k = first + 1; k < first + count; ++k) c.lineTo(seen[3 * k], seen[3 * k + 1]);
    c.strokeStyle = tint;
    c.lineWidth = 3;
    c.lineJoin = c.lineCap = "round";
    c.stroke();
  }

  // A rigid body: the silhouette of its markers, filled lightly.
  star(first, count, tint) {
    const c = this.context, tips = [];
    for (let k = first + 1; k < first + count; k += 2) tips.push(this.seen[3 * k], this.seen[3 * k + 1]);
    c.beginPath();
    hull(tips).forEach(([x, y], k) => (k ? c.lineTo(x, y) : c.moveTo(x, y)));
    c.closePath();
    c.fillStyle = c.strokeStyle = tint;
    const alpha = c.globalAlpha;
    c.globalAlpha = alpha * (this.camera.spatial ? 0.55 : 0.22);
    c.fill();
    c.globalAlpha = alpha;
    c.lineWidth = 1.5;
    c.lineJoin = "round";
    c.stroke();
  }

  ball_part({ first }, radius) {
    const draw = (tint) => {
      const c = this.context, alpha = c.globalAlpha, pixels = Math.max(1, (radius || 0) * this.camera.scale);
      c.globalAlpha = alpha * 0.3;
      this.disc(first, pixels, tint);
      c.globalAlpha = alpha;
      this.disc(first, pixels, tint, false);
    };
    return { depth: this.seen[3 * first + 2], draw };
  }

  add_quads(face, animation, parts) {
    const { quads } = face, { place, value } = animation, light = [0.35, -0.5, 0.8];
    const span = animation.top_colour - animation.low_value || 1;
    for (let q = 0; q < quads.length; q += 5) {
      const [a, b, d, e] = [quads[q], quads[q + 1], quads[q + 2], quads[q + 3]].map((k) => face.first + k);
      const side = (from, to, i) => place[3 * to + i] - place[3 * from + i];
      const nx = side(a, d, 1) * side(b, e, 2) - side(a, d, 2) * side(b, e, 1);
      const ny = side(a, d, 2) * side(b, e, 0) - side(a, d, 0) * side(b, e, 2);
      const nz = side(a, d, 0) * side(b, e, 1) - side(a, d, 1) * side(b, e, 0);
      const length = Math.hypot(nx, ny, nz) || 1;
      const lit = Math.abs(nx * light[0] + ny * light[1] + nz * light[2]) / length;
      const mean = (value[face.first_value + quads[q]] + value[face.first_value + quads[q + 1]] +
        value[face.first_value + quads[q + 2]] + value[face.first_value + quads[q + 3]]) / 4;
      parts.push({ quad: [a, b, d, e], outline: quads[q + 4], colour: shade((mean - animation.low_value) / span, lit),
        depth: (this.seen[3 * a + 2] + this.seen[3 * b + 2] + this.seen[3 * d + 2] + this.seen[3 * e + 2]) / 4 });
    }
  }

  // The fill, with a thin border of the same colour that closes gaps, then the lines of the element.
  quad({ quad, outline, colour }, tint) {
    const c = this.context, { seen } = this;
    c.beginPath();
    quad.forEach((k, i) => (i ? c.lineTo(seen[3 * k], seen[3 * k + 1]) : c.moveTo(seen[3 * k], seen[3 * k + 1])));
    c.closePath();
    c.fillStyle = c.strokeStyle = tint || colour;
    c.lineWidth = 0.7;
    c.fill();
    c.stroke();
    if (!this.meshed || !outline) return;
    c.beginPath();
    for (let i = 0; i < 4; ++i) {
      if (!(outline & (1 << i))) continue;
      const [from, to] = [quad[i], quad[(i + 1) % 4]];
      c.moveTo(seen[3 * from], seen[3 * from + 1]);
      c.lineTo(seen[3 * to], seen[3 * to + 1]);
    }
    c.strokeStyle = "rgba(10, 16, 24, 0.55)";
    c.lineWidth = 0.8;
    c.stroke();
  }

  joints(layout) {
    const c = this.context;
    for (const { first } of layout.joints) {
      c.beginPath();
      c.arc(this.seen[3 * first], this.seen[3 * first + 1], 4, 0, 2 * Math.PI);
      c.fillStyle = this.card;
      c.strokeStyle = this.ink;
      c.lineWidth = 1.5;
      c.fill();
      c.stroke();
    }
  }

  // Arrows of a frame: the longest force of the run takes `longest` pixels.
  arrows(list, largest, longest) {
    for (const { contact, from, at, force } of list) {
      const [x, y] = this.camera.point(at);
      if (from) this.spring(this.camera.point(from), [x, y]);
      const size = Math.hypot(...force);
      if (!(size > 1e-9 * largest)) continue;
      const [dx, dy] = this.camera.direction(force), flat = Math.hypot(dx, dy);
      if (!(flat > 0)) continue;
      // Foreshortened like the picture; at least about a tenth of the longest, so that small forces are visible.
      const length = longest * Math.max(0.12, size / largest) * (flat / (size * this.camera.scale));
      this.arrow(x, y, (dx / flat) * length, (dy / flat) * length, contact ? colour_of(1) : colour_of(3));
    }
  }

  spring([x0, y0], [x1, y1]) {
    if (Math.hypot(x1 - x0, y1 - y0) < 2) return;
    const c = this.context;
    c.beginPath();
    c.setLineDash([4, 4]);
    c.moveTo(x0, y0);
    c.lineTo(x1, y1);
    c.strokeStyle = colour_of(3);
    c.lineWidth = 1.5;
    c.stroke();
    c.setLineDash([]);
  }

  arrow(x, y, dx, dy, colour) {
    const c = this.context, length = Math.hypot(dx, dy), head = Math.min(9, length / 2);
    if (length < 2) return;
    const [ux, uy] = [dx / length, dy / length], [tx, ty] = [x + dx, y + dy];
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(tx - ux * head, ty - uy * head);
    c.strokeStyle = c.fillStyle = colour;
    c.lineWidth = 2.5;
    c.stroke();
    c.beginPath();
    c.moveTo(tx, ty);
    c.lineTo(tx - ux * head - uy * head * 0.5, ty - uy * head + ux * head * 0.5);
    c.lineTo(tx - ux * head + uy * head * 0.5, ty - uy * head - ux * head * 0.5);
    c.closePath();
    c.fill();
  }

  // A length of the world in a corner, and the axes of space.
  scale_bar() {
    const c = this.context, rough = 90 / this.camera.scale, power = 10 ** Math.floor(Math.log10(rough));
    const size = power * ([5, 2, 1].find((m) => m * power <= rough) || 1), width = size * this.camera.scale;
    const x = 14, y = this.height - 14;
    c.strokeStyle = c.fillStyle = this.soft;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(x, y - 4);
    c.lineTo(x, y);
    c.lineTo(x + width, y);
    c.lineTo(x + width, y - 4);
    c.stroke();
    c.font = "12px system-ui, sans-serif";
    c.textAlign = "left";
    c.fillText(`${number_text(size)} m`, x + width + 7, y + 2);
    if (this.camera.spatial) this.axes(x + 26, y - 48);
  }

  axes(x, y) {
    const c = this.context;
    for (const [k, name] of ["x", "y", "z"].entries()) {
      const [dx, dy] = [24 * this.camera.right[k], -24 * this.camera.up[k]];
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(x + dx, y + dy);
      c.stroke();
      c.textAlign = "center";
      c.fillText(name, x + 1.35 * dx, y + 1.35 * dy + 4);
    }
  }
}
