/** Lamps, numbers at the cursor, legend and events: the page apart from the picture and the plots. */

/** Label, unit, digits and value (of a run, at a time) of each number. */
const NUMBERS = [
  ["time", "s", 3, (run, time) => time],
  ["speed", "km/h", 1, (run, time) => 3.6 * run.at("u", time)],
  ["roll", "deg", 2, (run, time) => DEGREES * run.at("roll", time)],
  ["roll rate", "deg/s", 1, (run, time) => DEGREES * run.at("roll_rate", time)],
  ["lateral acc.", "m/s²", 2, (run, time) => run.at("lateral_acceleration", time)],
  ["load transfer", "", 3, (run, time) => run.loadTransfer(time)],
];

/** That of a tilt table, if a run has one. */
const TABLE = ["tilt table", "deg", 2, (run, time) => DEGREES * run.at("tilt", time)];

function element(kind, text, settings = {}) {
  const made = Object.assign(document.createElement(kind), settings);
  if (text) made.textContent = text;
  return made;
}

class Lamps {
  constructor(parent) {
    this.lamps = [...WHEELS, "rollover"].map((name) => {
      const lamp = element("li", name, { className: "lamp" });
      lamp.title = name === "rollover" ? "lit from the rollover on" : `lit while wheel ${name} is off the ground`;
      parent.append(lamp);
      return lamp;
    });
  }

  show(run, time) {
    this.lit = [...run.lifted(time), run.hasRolledOver(time)];
    this.lamps.forEach((lamp, k) => {
      lamp.classList.toggle("on", this.lit[k]);
      const [on, off] = k < WHEELS.length ? ["lifted", "on the ground"] : ["yes", "no"];
      lamp.setAttribute("aria-label", `${lamp.textContent}: ${this.lit[k] ? on : off}`);
    });
  }
}

class Numbers {
  constructor(parent, recordings) {
    const tilts = recordings.some((run) => run.columns.tilt);
    this.numbers = tilts ? [...NUMBERS, TABLE] : NUMBERS;
    this.values = this.numbers.map(([label, unit]) => {
      const row = element("div"), value = element("dd");
      row.append(element("dt", label), value, element("dd", unit));
      parent.append(row);
      return value;
    });
  }

  show(run, time) {
    this.numbers.forEach(([, , digits, of], k) => {
      this.values[k].textContent = shown(of(run, time), digits);
    });
  }
}

/** Buttons of the runs; the chosen one is followed. */
function legend(parent, recordings, onChoose) {
  const buttons = recordings.map((run) => {
    const button = element("button", "", { type: "button", title: `Follow ${run.label}` });
    button.append(element("span", "", { className: `swatch run-${run.index}` }), element("span", run.label));
    button.addEventListener("click", () => choose(run.index));
    const item = element("li");
    item.append(button);
    parent.append(item);
    return button;
  });
  const choose = (index) => {
    buttons.forEach((each, k) => each.setAttribute("aria-pressed", String(k === index)));
    onChoose(index);
  };
  return choose;
}

/** Marks of the events on the time line, and the list of them; returns what moves them to a range. */
function eventMarks(recordings, onSeek) {
  const line = $("marks"), list = $("event-list"), marks = [];
  line.replaceChildren();
  list.replaceChildren();
  for (const run of recordings) {
    for (const { time, name, isSevere } of run.events) {
      const who = recordings.length > 1 ? `${run.label}: ` : "";
      const text = `${who}${name}, ${shown(time, 3)} s`;
      const mark = element("button", "", { type: "button", title: text });
      mark.setAttribute("aria-label", text);
      mark.classList.toggle("severe", isSevere);
      marks.push({ mark, time });
      const entry = element("li"), button = element("button", text, { type: "button" });
      entry.append(button);
      for (const each of [mark, button]) each.addEventListener("click", () => onSeek(time));
      line.append(mark);
      list.append(entry);
    }
  }
  $("events").hidden = !list.children.length;
  return ([begin, end]) => marks.forEach(({ mark, time }) => {
    mark.style.left = `${(100 * (time - begin)) / (end - begin)}%`;
  });
}

/** The text for screen readers at a time. */
function spoken(run, time) {
  const up = WHEELS.filter((_, k) => run.lifted(time)[k]);
  const roll = shown(DEGREES * run.at("roll", time), 1);
  const wheels = up.length ? `${up.join(", ")} off the ground` : "all wheels on the ground";
  return `${shown(time, 2)} s: roll ${roll} degrees, ${wheels}${run.hasRolledOver(time) ? ", rolled over" : ""}`;
}
