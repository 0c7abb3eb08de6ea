// The part of the plane that all stages show.

class View {
  centre = [0, 0];
  /** Pixels for a unit of length. */
  scale = 1;
  /** Whether it is still as it was fitted. */
  isFitted = false;

  /** Where a point is on a stage of a size. */
  toScreen([x, y], { width, height }) {
    return [width / 2 + (x - this.centre[0]) * this.scale, height / 2 - (y - this.centre[1]) * this.scale];
  }

  /** The point at a place of a stage. */
  toPlane([x, y], { width, height }) {
    return [this.centre[0] + (x - width / 2) / this.scale, this.centre[1] - (y - height / 2) / this.scale];
  }

  /** Shows a box on a stage of a size, with paper around it for signs and numbers. */
  fit(box, { width, height }) {
    const [wide, high] = [Math.max(width - 130, 40), Math.max(height - 130, 40)];
    const largest = Math.max(box.right - box.left, box.top - box.bottom);
    this.centre = Number.isFinite(largest) ? box.centre : [0, 0];
    this.scale = largest > 0 ? Math.min(wide / (box.right - box.left || largest * 1e-6), high / (box.top - box.bottom || largest * 1e-6)) : 100;
    this.fitted = this.scale;
    this.isFitted = true;
  }

  move(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
    this.isFitted = false;
  }

  /** Zooms so that what is at a place of the screen stays there. */
  zoom(factor, at, size, finest) {
    const fixed = this.toPlane(at, size);
    this.scale = Math.min(Math.max(this.scale * factor, this.fitted / 50), finest);
    this.isFitted = false;
    const now = this.toPlane(at, size);
    this.centre = [this.centre[0] + fixed[0] - now[0], this.centre[1] + fixed[1] - now[1]];
  }
}
