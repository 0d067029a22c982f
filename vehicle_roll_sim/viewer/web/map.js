/** The map of a study: a point for each run, over two quantities and in the colour of a third. */

/** Size of the drawing, and space around it for axes (units of the drawing). */
const MAP = { width: 480, height: 400, left: 64, right: 14, top: 10, bottom: 40 };
const RAMP = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
const OF_TEXTS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

function drawn(kind, settings, text = "") {
  const made = document.createElementNS("http://www.w3.org/2000/svg", kind);
  for (const [name, value] of Object.entries(settings)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

/** A colour between dark blue and yellow for a share from 0 to 1. */
function ramp(share) {
  const at = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1), k = Math.min(Math.floor(at), RAMP.length - 2);
  const mixed = RAMP[k].map((low, i) => Math.round(low + (at - k) * (RAMP[k + 1][i] - low)));
  return `rgb(${mixed.join()})`;
}

/** A quantity of all points: where a value lies between its limits, its ticks, texts and colours. */
class Scale {
  constructor({ label, texts, values }) {
    const known = values.filter((value) => value !== null);
    Object.assign(this, { label, texts, values });
    const [low, high] = known.length ? [Math.min(...known), Math.max(...known)] : [0, 1];
    const margin = texts.length ? 0.5 : 0.06 * (high - low) || 0.5;
    this.inner = [low, high];
    this.limits = [low - margin, high + margin];
  }

  share(value) {
    return (value - this.limits[0]) / (this.limits[1] - this.limits[0]);
  }

  text(value) {
    if (value === null) return "unknown";
    return this.texts.length ? this.texts[value] : String(Number(value.toPrecision(4)));
  }

  colour(value) {
    if (this.texts.length) return OF_TEXTS[value % OF_TEXTS.length];
    const [low, high] = this.inner;
    return ramp(high > low ? (value - low) / (high - low) : 0.5);
  }

  get ticks() {
    if (this.texts.length) return [...new Set(this.values)].filter((value) => value !== null);
    return ticks(...this.limits, 5);
  }

  /** Values and their texts for the legend of colours. */
  get legend() {
    const [low, high] = this.inner;
    const values = this.texts.length ? this.ticks.sort((a, b) => a - b) : [low, (low + high) / 2, high];
    return [...new Set(values)].map((value) => [this.colour(value), this.text(value)]);
  }
}

class StudyMap {
  /** chosen: places of the runs that are shown. open: called with a place, and whether beside them. */
  constructor(parent, told, chosen, open) {
    Object.assign(this, { told, chosen, open });
    this.scales = told.quantities.map((each) => new Scale(each));
    this.svg = parent.querySelector("svg");
    this.legend = parent.querySelector("ul");
    this.selects = ["right", "up", "colour"].map((name, k) => {
      const select = parent.querySelector(`[data-axis=${name}]`);
      this.scales.forEach(({ label }, place) => select.append(new Option(label, place)));
      select.value = told.axes[k];
      select.addEventListener("change", () => this.draw());
      return select;
    });
    const opening = told.points.filter((each) => each.place !== null).length;
    parent.querySelector("p").textContent = `${told.count} runs. Points with a rim (${opening}) open their `
      + "runs; with shift or control, beside those shown.";
    this.svg.addEventListener("click", (event) => this.press(event));
    this.svg.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") this.press(event);
    });
    this.draw();
  }

  press(event) {
    const point = event.target.closest("[data-place]");
    if (!point) return;
    event.preventDefault();
    this.open(Number(point.dataset.place), event.shiftKey || event.ctrlKey || event.metaKey);
  }

  /** Axes, then the points; those that open a run on top. */
  draw() {
    const [right, up, colour] = this.selects.map((each) => this.scales[each.value]);
    this.x = (value) => MAP.left + right.share(value) * (MAP.width - MAP.left - MAP.right);
    this.y = (value) => MAP.height - MAP.bottom - up.share(value) * (MAP.height - MAP.top - MAP.bottom);
    const points = this.told.points.map((each, k) => ({ ...each, at: [right, up, colour].map((s) => s.values[k]) }));
    const placed = points.filter(({ at }) => at[0] !== null && at[1] !== null);
    placed.sort((a, b) => (a.place !== null) - (b.place !== null));
    this.svg.replaceChildren(...this.axes(right, up), ...placed.map((each) => this.point(each, [right, up, colour])));
    this.legend.replaceChildren(...colour.legend.map(([fill, text]) => {
      const item = element("li"), mark = drawn("svg", { viewBox: "0 0 10 10" });
      mark.append(drawn("circle", { cx: 5, cy: 5, r: 5, fill }));
      item.append(mark, ` ${text}`);
      return item;
    }));
  }

  axes(right, up) {
    const { left, top, bottom, width, height } = MAP, floor = height - bottom;
    const across = right.ticks.flatMap((value) => [
      drawn("line", { x1: this.x(value), x2: this.x(value), y1: top, y2: floor }),
      drawn("text", { x: this.x(value), y: floor + 15, "text-anchor": "middle" }, right.text(value))]);
    const along = up.ticks.flatMap((value) => [
      drawn("line", { x1: left, x2: width - MAP.right, y1: this.y(value), y2: this.y(value) }),
      drawn("text", { x: left - 5, y: this.y(value) + 4, "text-anchor": "end" }, up.text(value))]);
    const middle = (top + floor) / 2;
    return [...across, ...along,
      drawn("text", { x: (left + width) / 2, y: height - 6, "text-anchor": "middle" }, right.label),
      drawn("text", { transform: `translate(14 ${middle}) rotate(-90)`, "text-anchor": "middle" }, up.label)];
  }

  radius(place) {
    if (place === null) return 4;
    return this.chosen.includes(place) ? 10 : 7;
  }

  point({ run, place, at }, scales) {
    const said = scales.map((scale, k) => `${scale.label} ${scale.text(at[k])}`).join(", ");
    const fill = at[2] === null ? "none" : scales[2].colour(at[2]);
    const made = drawn("circle", { cx: this.x(at[0]), cy: this.y(at[1]), r: this.radius(place), fill });
    made.append(drawn("title", {}, `run ${run}: ${said}`));
    if (at[2] === null) made.classList.add("unknown");
    if (place === null) return made;
    made.classList.toggle("shown", this.chosen.includes(place));
    const button = { role: "button", tabindex: 0, "data-place": place, "aria-label": `Open run ${run}: ${said}` };
    for (const [name, value] of Object.entries(button)) made.setAttribute(name, value);
    return made;
  }
}
