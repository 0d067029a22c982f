/** Panels of the standard figure over a common time: curves, lift-off shaded, rollover marked. */

/** Height of a plot (CSS pixels) and space for the axis labels. */
const PLOT = { height: 112, left: 46, right: 8, top: 6, bottom: 16 };
/** s: the shortest time that the plots show. */
const SHORTEST = 0.1;
const DASHES = [[], [6, 3], [6, 3, 2, 3], [2, 3]];

/** About `count` round values between two limits. */
function ticks(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= raw);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
  return found;
}

function tickText(value, step) {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return shown(value, Math.min(digits, 6));
}

class Panel {
  constructor(told, index, recordings, range) {
    Object.assign(this, { told, index, recordings, range });
    this.curves = recordings.flatMap((run) =>
      run.curves[index].map(({ column, name }, k) => ({ run, column, name, dash: DASHES[k % 4] })));
    this.figure = document.createElement("figure");
    this.figure.className = "panel";
    const caption = document.createElement("figcaption");
    const title = document.createElement("span");
    title.textContent = told.title;
    this.values = document.createElement("span");
    caption.append(title, this.values);
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.figure.append(caption, this.canvas);
    this.cursor = this.line("cursor");
    this.hover = this.line("cursor hover");
    this.renew();
  }

  /** Fit the panel to the present samples. */
  renew() {
    this.canvas.setAttribute("aria-label", `${this.told.title} over time. ${this.summary()}`);
    this.limits = this.extent();
  }

  line(kind) {
    const line = document.createElement("div");
    line.className = kind;
    this.figure.append(line);
    return line;
  }

  /** Smallest and largest value of each curve, in words. */
  summary() {
    const said = this.curves.map(({ run, column, name }) => {
      const values = run.columns[column].filter(Number.isFinite);
      const who = [run.label, name].filter(Boolean).join(", ");
      if (!values.length) return `${who}: no data`;
      const [low, high] = [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
      return `${who}: ${shown(low, 2)} to ${shown(high, 2)}`;
    });
    return said.join("; ");
  }

  extent() {
    if (this.told.limits) return this.told.limits;
    let low = Infinity, high = -Infinity;
    for (const { run, column } of this.curves) {
      for (const value of run.columns[column]) {
        if (!Number.isFinite(value)) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    if (low > high) return [0, 1];
    const span = Math.max(high - low, this.told.span), middle = (low + high) / 2;
    return [middle - 0.54 * span, middle + 0.54 * span];
  }

  x(time) {
    const { left, right } = PLOT, [begin, end] = this.range;
    return left + ((time - begin) / (end - begin)) * (this.width - left - right);
  }

  y(value) {
    const { top, bottom, height } = PLOT, [low, high] = this.limits;
    return height - bottom - ((value - low) / (high - low)) * (height - top - bottom);
  }

  timeAt(x) {
    const { left, right } = PLOT, [begin, end] = this.range;
    const share = (x - left) / (this.width - left - right);
    return begin + Math.min(Math.max(share, 0), 1) * (end - begin);
  }

  draw(colour) {
    this.width = this.canvas.clientWidth;
    const scale = window.devicePixelRatio || 1, pen = this.canvas.getContext("2d");
    this.canvas.width = Math.round(this.width * scale);
    this.canvas.height = Math.round(PLOT.height * scale);
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    this.drawAxes(pen, colour);
    const inner = this.width - PLOT.left - PLOT.right;
    pen.save();
    pen.beginPath();
    pen.rect(PLOT.left, PLOT.top - 1, inner, PLOT.height - PLOT.top - PLOT.bottom + 2);
    pen.clip();
    if (this.told.wheel !== null) this.shade(pen, colour);
    for (const curve of this.curves) this.drawCurve(pen, colour, curve);
    pen.restore();
    for (const line of [this.cursor, this.hover]) {
      const below = this.figure.clientHeight - this.canvas.offsetTop - PLOT.height;
      line.style.bottom = `${below + PLOT.bottom}px`;
      line.style.height = `${PLOT.height - PLOT.top - PLOT.bottom}px`;
    }
  }

  drawAxes(pen, colour) {
    const [low, high] = this.limits, [begin, end] = this.range;
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = colour("--faint");
    pen.strokeStyle = colour("--grid");
    pen.lineWidth = 1;
    const levels = ticks(low, high, 5), times = ticks(begin, end, Math.max(this.width / 50, 2));
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const level of levels) {
      pen.strokeRect(PLOT.left, Math.round(this.y(level)) + 0.5, this.width - PLOT.left - PLOT.right, 0);
      pen.fillText(tickText(level, levels[1] - levels[0] || 1), PLOT.left - 5, this.y(level));
    }
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    for (const time of times) {
      pen.strokeRect(Math.round(this.x(time)) + 0.5, PLOT.top, 0, PLOT.height - PLOT.top - PLOT.bottom);
      pen.fillText(tickText(time, times[1] - times[0] || 1), this.x(time), PLOT.height - 4);
    }
  }

  drawCurve(pen, colour, { run, column, dash }) {
    const values = run.columns[column];
    pen.strokeStyle = colour(`--run-${run.index}`);
    pen.lineWidth = 1.6;
    pen.setLineDash(dash);
    pen.beginPath();
    let isDrawing = false;
    for (let k = 0; k < values.length; k++) {
      const isKnown = Number.isFinite(values[k]);
      if (isKnown) pen[isDrawing ? "lineTo" : "moveTo"](this.x(run.time[k]), this.y(values[k]));
      isDrawing = isKnown;
    }
    pen.stroke();
    pen.setLineDash([2, 3]);
    pen.strokeRect(this.x(run.rollover), PLOT.top, 0, PLOT.height);
    pen.setLineDash([]);
  }

  /** Shade the times at which this wheel is off the ground, each run in its own part of the height. */
  shade(pen, colour) {
    const runs = this.recordings, height = (PLOT.height - PLOT.top - PLOT.bottom) / runs.length;
    const name = WHEELS[this.told.wheel];
    runs.forEach((run, row) => {
      const compression = run.columns[`tire_compression_${name}`];
      const loads = run.columns[`normal_force_${name}`];
      const isUp = (k) => (Number.isNaN(compression[k]) ? loads[k] <= 0 : compression[k] <= NO_COMPRESSION);
      pen.fillStyle = colour(`--run-${run.index}`);
      pen.globalAlpha = 0.2;
      let from = null;
      for (let k = 0; k < run.time.length; k++) {
        if (isUp(k) && from === null) from = k;
        if (from === null || (isUp(k) && k < run.time.length - 1)) continue;
        const begin = this.x(run.time[from]);
        pen.fillRect(begin, PLOT.top + row * height, Math.max(this.x(run.time[k]) - begin, 1), height);
        from = null;
      }
      pen.globalAlpha = 1;
    });
  }

  /** Move the cursor, and the line of the pointer if it is on a plot; show the values there. */
  mark(time, hovered) {
    const place = (line, at) => {
      line.hidden = at === null;
      line.style.left = `${this.canvas.offsetLeft + this.x(at ?? 0)}px`;
    };
    place(this.cursor, time);
    place(this.hover, hovered);
    this.values.replaceChildren(...this.curves.map(({ run, column, name }) => {
      const value = document.createElement("b");
      value.className = `run-${run.index}`;
      value.textContent = (name ? `${name} ` : "") + brief(run.at(column, hovered ?? time), this.told.digits);
      return value;
    }));
  }
}

/** All panels; `onSeek` is called with the time that was clicked. whole: range of all runs (s). */
class Plots {
  constructor(parent, panels, recordings, whole, onSeek) {
    this.whole = whole;
    this.range = [...whole];
    this.panels = panels.map((told, k) => new Panel(told, k, recordings, this.range));
    this.hovered = null;
    parent.append(...this.panels.map((each) => each.figure));
    for (const panel of this.panels) {
      const time = (event) => panel.timeAt(event.offsetX), { canvas } = panel;
      canvas.addEventListener("pointerdown", (event) => onSeek(time(event)));
      canvas.addEventListener("pointermove", (event) => {
        if (event.buttons) onSeek(time(event));
        this.hover(time(event));
      });
      canvas.addEventListener("pointerleave", () => this.hover(null));
    }
    new ResizeObserver(() => this.draw()).observe(parent);
  }

  /** Show the samples that have been added; `whole` has moved from another range. */
  renew([begin, end]) {
    const [from, to] = this.range;
    if (from === begin && to === end) this.range.splice(0, 2, ...this.whole);
    else this.turnTo(from, Math.min(to - from, this.whole[1] - this.whole[0]));
    this.time = Math.min(Math.max(this.time, this.whole[0]), this.whole[1]);
    for (const panel of this.panels) panel.renew();
    this.draw();
  }

  hover(time) {
    this.hovered = time;
    this.show(this.time);
  }

  /** Show a shorter or, with a factor below 1, a longer time about the cursor; 0: all of it. */
  zoom(factor) {
    const [begin, end] = this.range, whole = this.whole[1] - this.whole[0];
    const span = factor ? Math.min(Math.max((end - begin) / factor, SHORTEST), whole) : whole;
    this.turnTo(this.time - span / 2, span);
    this.draw();
  }

  /** Let the plots begin at a time, or as near to it as the runs allow. */
  turnTo(begin, span) {
    this.range[0] = Math.max(Math.min(begin, this.whole[1] - span), this.whole[0]);
    this.range[1] = this.range[0] + span;
  }

  show(time) {
    const [begin, end] = this.range, isOutside = time < begin || time > end;
    this.time = time;
    if (isOutside) {
      this.turnTo(time - 0.1 * (end - begin), end - begin);
      this.draw();
    }
    for (const panel of this.panels) panel.mark(time, this.hovered);
  }

  draw() {
    const style = getComputedStyle(document.documentElement);
    for (const panel of this.panels) panel.draw((name) => style.getPropertyValue(name).trim());
    this.show(this.time);
  }
}
