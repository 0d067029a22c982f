/** Assembles the page. `window.viewer` gives scripts the functions of the buttons, and the state. */

function $(id) {
  return document.getElementById(id);
}

class Page {
  constructor(told) {
    const chosen = chosenRuns(told), recordings = chosen.map((run, k) => new Recording(told.runs[run], k, told.on[run]));
    this.recordings = recordings;
    this.followed = recordings[0];
    this.range = this.wholeTime();
    this.playback = new Playback(this.range, [], (time) => this.show(time));
    this.plots = new Plots($("plots"), told.panels, recordings, this.range, (time) => this.playback.seek(time));
    this.lamps = new Lamps($("lamps"));
    this.numbers = new Numbers($("numbers"), recordings);
    this.picture = this.pictureOf(told);
    $("notes").textContent = told.notes.join(" ");
    offerRuns($("choice"), told, chosen);
    offerMap($("map"), told, chosen);
    this.markEvents();
    $("legend").hidden = told.runs.length < 2;
    this.follow = legend($("legend"), recordings, (index) => this.choose(index));
  }

  /** First and last time of the runs (s). */
  wholeTime() {
    const begin = Math.min(...this.recordings.map((run) => run.begin));
    return [begin, Math.max(...this.recordings.map((run) => run.end), begin + SHORTEST_RUN)];
  }

  markEvents() {
    Object.assign($("scrub"), { min: this.range[0], max: this.range[1] });
    const events = this.recordings.map((run) => run.events), known = JSON.stringify(events);
    if (known !== this.marked) {
      this.marked = known;
      this.playback.stopAt(events.flat().map((each) => each.time));
      this.placeMarks = eventMarks(this.recordings, (time) => this.goTo(time));
    }
    this.placeMarks(this.range);
  }

  /** Show what has been added to the runs. road: that of the first one, if it is another. */
  renew(road) {
    const before = [...this.range];
    this.range.splice(0, 2, ...this.wholeTime());
    this.markEvents();
    if (this.picture) this.picture.renew(road);
    this.plots.renew(before);
  }

  /** The 3D view; null, with a message, where there is no WebGL. */
  pictureOf({ cones, roads }) {
    try {
      const picture = new Picture($("picture"), this.recordings, cones, roads);
      picture.onFree = () => this.use("free");
      return picture;
    } catch (error) {
      $("no-picture").hidden = false;
      $("picture").hidden = $("cameras").hidden = true;
      return null;
    }
  }

  show(time) {
    const { picture, plots, lamps, numbers, followed, playback } = this;
    if (picture) picture.show(time);
    plots.show(time);
    lamps.show(followed, time);
    numbers.show(followed, time);
    $("scrub").value = time;
    $("scrub").setAttribute("aria-valuetext", `${shown(time, 2)} s`);
    $("clock").textContent = `${shown(time, 3)} / ${shown(this.range[1], 2)} s`;
    if (!playback.isPlaying) $("spoken").textContent = spoken(followed, time);
  }

  /** Stop at a time. */
  goTo(time) {
    this.playback.play(false);
    this.playback.seek(time);
  }

  /** Use a camera. */
  use(camera) {
    document.querySelectorAll("[data-camera]").forEach((each) =>
      each.setAttribute("aria-pressed", String(each.dataset.camera === camera)));
    if (this.picture && this.picture.view !== camera) this.picture.use(camera);
  }

  /** Follow a run. */
  choose(index) {
    this.followed = this.recordings[index];
    if (this.picture) this.picture.choose(index);
    this.show(this.playback.time);
  }

  /** Use the colours of a theme. */
  paint(theme) {
    document.documentElement.dataset.theme = theme;
    if (this.picture) this.picture.paint();
    this.plots.draw();
  }

  state() {
    return {
      time: this.playback.time,
      isPlaying: this.playback.isPlaying,
      lamps: this.lamps.lit,
      wheels: this.picture && WHEELS.map((_, k) => this.picture.vehicle.centre(k).toArray()),
      run: this.followed.index,
      isFollowing: this.playback.isFollowing,
    };
  }
}

function main() {
  const told = JSON.parse($("data").textContent), page = new Page(told);
  bindControls(page);
  page.paint(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  page.use("chase");
  page.follow(0);
  window.viewer = {
    seek: (time) => page.playback.seek(time),
    play: (isPlaying) => page.playback.play(isPlaying),
    use: (camera) => page.use(camera),
    paint: (theme) => page.paint(theme),
    choose: (index) => page.follow(index),
    render: () => page.picture && page.picture.render(),
    state: () => page.state(),
  };
  fromAddress(window.viewer, page.recordings.length);
  if (told.feed) new Feed(page, told.feed);
}

main();
