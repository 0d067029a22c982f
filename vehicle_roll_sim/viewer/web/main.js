/** Assembles the page. `window.viewer` gives scripts the functions of the buttons, and the state. */

function $(id) {
  return document.getElementById(id);
}

class Page {
  constructor(told) {
    const chosen = chosenRuns(told), recordings = chosen.map((run, k) => new Recording(told.runs[run], k));
    const begin = Math.min(...recordings.map((run) => run.begin));
    const end = Math.max(...recordings.map((run) => run.end), begin + SHORTEST_RUN);
    const stops = recordings.flatMap((run) => run.events.map((each) => each.time));
    this.recordings = recordings;
    this.followed = recordings[0];
    this.range = [begin, end];
    this.playback = new Playback(this.range, stops, (time) => this.show(time));
    this.plots = new Plots($("plots"), told.panels, recordings, this.range, (time) => this.playback.seek(time));
    this.lamps = new Lamps($("lamps"));
    this.numbers = new Numbers($("numbers"));
    this.picture = this.pictureOf(told.cones);
    $("notes").textContent = told.notes.join(" ");
    offerRuns($("choice"), told, chosen);
    offerMap($("map"), told, chosen);
    eventMarks(recordings, this.range, (time) => this.goTo(time));
    $("legend").hidden = told.runs.length < 2;
    this.follow = legend($("legend"), recordings, (index) => this.choose(index));
  }

  /** The 3D view; null, with a message, where there is no WebGL. */
  pictureOf(cones) {
    try {
      const picture = new Picture($("picture"), this.recordings, cones);
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
    };
  }
}

function main() {
  const page = new Page(JSON.parse($("data").textContent));
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
}

main();
