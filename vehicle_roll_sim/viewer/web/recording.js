"use strict";

/** Names of the wheels, in the order of all quantities with one value for each wheel. */
const WHEELS = ["lf", "rf", "lr", "rr"];
/** m: a tire compression below this counts as none; more than the rounding of 32-bit numbers. */
const NO_COMPRESSION = 1e-6;
const DEGREES = 180 / Math.PI;

/** Bytes of a base64 text. */
function bytesOf(text) {
  return Uint8Array.from(atob(text), (each) => each.charCodeAt(0)).buffer;
}

/** One run: columns over time, linear between samples. */
class Recording {
  /** road: place of its road among those of the page, null for a plane. */
  constructor(told, index, road) {
    const { label, vehicle, curves } = told;
    Object.assign(this, { index, road, label, vehicle, curves });
    this.hold(told);
  }

  /** Take over the samples and events of another run of the vehicle. */
  hold(told) {
    const time = new Float64Array(bytesOf(told.time)), rows = time.length;
    const values = new Float32Array(bytesOf(told.values)), columns = {};
    told.columns.forEach((name, k) => {
      columns[name] = values.subarray(k * rows, (k + 1) * rows);
    });
    this.keep(time, columns, told);
  }

  /** Append samples, the first of which is the last one so far, and drop those before `begin`. */
  append(told) {
    const { time, columns } = this, last = time.length - 1;
    this.hold(told);
    const from = Math.max(time.findIndex((each) => each >= told.begin), 0);
    const joined = (before, after, shift = 0) => {
      const all = new before.constructor(last - from + after.length);
      all.set(before.subarray(from, last));
      all.set(after.map((each) => each + shift), last - from);
      return all;
    };
    const turned = (name) => (name.startsWith("wheel_angle") ? columns[name][last] : 0);
    const added = Object.entries(this.columns);
    const all = added.map(([name, values]) => [name, joined(columns[name], values, turned(name))]);
    this.keep(joined(time, this.time), Object.fromEntries(all), told);
  }

  keep(time, columns, { rollover, events }) {
    Object.assign(this, { time, columns, events });
    const rows = time.length;
    this.begin = this.time[0];
    this.end = this.time[rows - 1];
    this.rollover = rollover === null ? Infinity : rollover;
    this.hasHeave = !this.columns.z.every(Number.isNaN);
  }

  /** The sample at or before a time, and the fraction of the way to the next. */
  place(time) {
    const last = this.time.length - 1;
    if (time >= this.end) return [last, 0];
    if (time <= this.begin) return [0, 0];
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= time) low = middle;
      else high = middle;
    }
    return [low, (time - this.time[low]) / (this.time[high] - this.time[low])];
  }

  /** A column at a time; NaN where it has no data. */
  at(name, time) {
    const values = this.columns[name];
    if (!values) return NaN;
    const [k, share] = this.place(time);
    return share ? values[k] + share * (values[k + 1] - values[k]) : values[k];
  }

  /** A column at all wheels. */
  wheels(quantity, time) {
    return WHEELS.map((wheel) => this.at(`${quantity}_${wheel}`, time));
  }

  /** Whether each wheel is off the ground: its tire is not compressed or, if unknown, not loaded. */
  lifted(time) {
    const loads = this.wheels("normal_force", time);
    return this.wheels("tire_compression", time).map((compression, i) =>
      Number.isNaN(compression) ? loads[i] <= 0 : compression <= NO_COMPRESSION);
  }

  /** Whether the vehicle has rolled over by then. */
  hasRolledOver(time) {
    return time >= this.rollover;
  }

  /** (right - left) / total of the normal loads, 0 if no tire carries load. */
  loadTransfer(time) {
    const [lf, rf, lr, rr] = this.wheels("normal_force", time);
    const total = lf + rf + lr + rr;
    return total === 0 ? 0 : (rf + rr - lf - lr) / total;
  }
}

/** Linear interpolation in an equidistant table; outside it, its end values. */
function tabulated(places, values, at) {
  const last = places.length - 1, share = ((at - places[0]) / (places[last] - places[0])) * last;
  const inside = Math.min(Math.max(share, 0), last), k = Math.min(Math.floor(inside), last - 1);
  return values[k] + (inside - k) * (values[k + 1] - values[k]);
}

/** A number as text with about four digits, and at most `digits` decimals. */
function brief(value, digits) {
  const whole = Math.floor(Math.log10(Math.max(Math.abs(value), 1))) + 1;
  return shown(value, Math.max(0, Math.min(digits, 4 - whole)));
}

/** A number as text, "–" if there is none. */
function shown(value, digits) {
  return Number.isFinite(value) ? value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1") : "–";
}
