// Maps points of the world to pixels: in the plane by a scale and a centre, in space by an orthographic view that turns
// about a centre, z up.

class Camera {
  constructor(dimension, box) {
    this.spatial = dimension === 3;
    this.box = box;
    this.reset();
    this.size = this.extent();
  }

  reset() {
    const [low, high] = this.box;
    this.centre = low.map((x, i) => (x + high[i]) / 2);
    this.zoom = 1;
    this.yaw = -0.9;
    this.tilt = 0.42;
  }

  // The size of the box as seen from the initial direction [m], which must fit into the picture.
  extent() {
    const side = this.box[0].map((x, i) => this.box[1][i] - x);
    if (!this.spatial) return [side[0], side[1]];
    this.look();
    const seen = (axis) => side.reduce((sum, x, i) => sum + x * Math.abs(axis[i]), 0);
    return [seen(this.right), seen(this.up)];
  }

  // The axes of the picture in the world.
  look() {
    const [c, s, ct, st] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.tilt), Math.sin(this.tilt)];
    this.right = this.spatial ? [c, s, 0] : [1, 0, 0];
    this.up = this.spatial ? [-s * st, c * st, ct] : [0, 1, 0];
    this.ahead = this.spatial ? [-s * ct, c * ct, -st] : [0, 0, -1]; // into the picture
  }

  aim(width, height) {
    const [w, h] = this.size;
    const least = Math.max(w, h, 1e-12) * 1e-3;
    this.scale = 0.82 * this.zoom * Math.min(width / Math.max(w, least), height / Math.max(h, least));
    if (!Number.isFinite(this.scale)) this.scale = 100;
    [this.middle_x, this.middle_y] = [width / 2, height / 2];
    this.look();
  }

  // Writes x, y [px] and depth [m] of the point at from[3 k].
  project(from, k, to, j) {
    const x = from[3 * k] - this.centre[0], y = from[3 * k + 1] - this.centre[1], z = from[3 * k + 2] - this.centre[2];
    const { right: r, up: u, ahead: a } = this;
    to[3 * j] = this.middle_x + this.scale * (r[0] * x + r[1] * y + r[2] * z);
    to[3 * j + 1] = this.middle_y - this.scale * (u[0] * x + u[1] * y + u[2] * z);
    to[3 * j + 2] = a[0] * x + a[1] * y + a[2] * z;
  }

  point(place) {
    const to = [0, 0, 0];
    this.project([place[0], place[1], place[2] || 0], 0, to, 0);
    return to;
  }

  // A vector's picture [px], without depth.
  direction(vector) {
    const [x, y, z] = [vector[0], vector[1], vector[2] || 0], { right: r, up: u } = this;
    return [this.scale * (r[0] * x + r[1] * y + r[2] * z), -this.scale * (u[0] * x + u[1] * y + u[2] * z)];
  }

  pan(dx, dy) {
    for (let i = 0; i < 3; ++i) this.centre[i] -= (this.right[i] * dx - this.up[i] * dy) / this.scale;
  }

  orbit(dx, dy) {
    this.yaw -= dx * 0.008;
    this.tilt = Math.max(-1.55, Math.min(1.55, this.tilt + dy * 0.008));
  }

  // About a pixel, which keeps its place.
  zoom_by(factor, x, y) {
    const before = this.zoom;
    this.zoom = Math.max(0.02, Math.min(5000, this.zoom * factor));
    const grown = this.zoom / before;
    this.pan((x - this.middle_x) * (1 / grown - 1), (y - this.middle_y) * (1 / grown - 1));
  }
}
