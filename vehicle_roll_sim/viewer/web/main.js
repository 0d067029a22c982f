/** Puts the page together. `window.viewer` is for scripts: what the buttons do, and the state. */

function main() {
  const told = JSON.parse(document.getElementById("data").textContent), $ = (id) => document.getElementById(id);
  const chosen = chosenRuns(told);
  const recordings = chosen.map((run, k) => new Recording(told.runs[run], k));
  const range = [Math.min(...recordings.map((r) => r.begin)), Math.max(...recordings.map((r) => r.end))];
  if (range[1] === range[0]) range[1] += 1e-3;
  $("notes").textContent = told.notes.join(" ");
  let picture = null, followed = recordings[0];
  const lamps = new Lamps($("lamps")), numbers = new Numbers($("numbers"));
  const stops = recordings.flatMap((run) => run.events.map((each) => each.time));
  const playback = new Playback(recordings, range, stops, (time) => show(time));
  const plots = new Plots($("plots"), told.panels, recordings, range, (time) => playback.seek(time));

  function show(time) {
    if (picture) picture.show(time);
    plots.show(time);
    lamps.show(followed, time);
    numbers.show(followed, time);
    $("scrub").value = time;
    $("scrub").setAttribute("aria-valuetext", `${shown(time, 2)} s`);
    $("clock").textContent = `${shown(time, 3)} / ${shown(range[1], 2)} s`;
    if (!playback.isPlaying) $("spoken").textContent = spoken(followed, time);
  }

  function use(camera) {
    document.querySelectorAll("[data-camera]").forEach((each) =>
      each.setAttribute("aria-pressed", String(each.dataset.camera === camera)));
    if (picture && picture.view !== camera) picture.use(camera);
  }

  function choose(index) {
    followed = recordings[index];
    if (picture) picture.choose(index);
    show(playback.time);
  }

  function paint(theme) {
    document.documentElement.dataset.theme = theme;
    if (picture) picture.paint();
    plots.draw();
  }

  try {
    picture = new Picture($("picture"), recordings, told.cones);
    picture.onFree = () => use("free");
  } catch (error) {
    $("no-picture").hidden = false;
    $("picture").hidden = $("cameras").hidden = true;
  }
  offerRuns($("choice"), told, chosen);
  const follow = legend($("legend"), recordings, choose);
  eventMarks(recordings, range, (time) => { playback.play(false); playback.seek(time); });
  bindControls(playback, () => followed, { use, paint, zoom: (factor) => plots.zoom(factor) });
  paint(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  use("chase");
  follow(0);
  window.viewer = {
    seek: (time) => playback.seek(time),
    play: (isPlaying) => playback.play(isPlaying),
    use,
    paint,
    choose: follow,
    render: () => picture && picture.render(),
    state: () => ({
      time: playback.time,
      isPlaying: playback.isPlaying,
      lamps: lamps.lit,
      wheels: picture && WHEELS.map((_, k) => picture.vehicle.centre(k).toArray()),
      run: followed.index,
    }),
  };
  fromAddress(window.viewer, recordings.length);
}

/** Buttons, keys and the time line. */
function bindControls(playback, followed, { use, paint, zoom }) {
  const $ = (id) => document.getElementById(id), [begin, end] = playback.range;
  const theme = () => paint(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  const change = (direction) => { playback.change(direction); $("speed").value = playback.speed; };
  const step = (direction, isLong) => (isLong
    ? playback.seek(playback.time + direction * LONG_STEP) : playback.step(followed(), direction));
  Object.assign($("scrub"), { min: begin, max: end });
  $("scrub").addEventListener("input", (event) => playback.seek(Number(event.target.value)));
  $("play").addEventListener("click", () => playback.play());
  $("back").addEventListener("click", () => step(-1));
  $("forward").addEventListener("click", () => step(1));
  $("theme").addEventListener("click", theme);
  for (const each of SPEEDS) $("speed").append(new Option(`${each} ×`, each));
  $("speed").value = playback.speed;
  $("speed").addEventListener("change", (event) => { playback.speed = Number(event.target.value); });
  document.querySelectorAll("[data-camera]").forEach((each) =>
    each.addEventListener("click", () => use(each.dataset.camera)));
  document.querySelectorAll("[data-zoom]").forEach((each) =>
    each.addEventListener("click", () => zoom(Number(each.dataset.zoom))));
  playback.onPlay = (isPlaying) => {
    $("play").classList.toggle("playing", isPlaying);
    $("play").setAttribute("aria-label", isPlaying ? "Pause" : "Play");
    if (!isPlaying) playback.seek(playback.time);
  };
  const keys = {
    " ": () => playback.play(), ArrowLeft: (event) => step(-1, event.shiftKey),
    ArrowRight: (event) => step(1, event.shiftKey), Home: () => playback.seek(begin),
    End: () => playback.seek(end), n: () => playback.stop(1), p: () => playback.stop(-1),
    "+": () => change(1), "-": () => change(-1), t: theme, i: () => zoom(4), o: () => zoom(0.25),
    1: () => use("chase"), 2: () => use("rear"), 3: () => use("top"), 4: () => use("free"),
  };
  document.addEventListener("keydown", (event) => {
    const isForButton = event.key === " " && event.target.closest("button, select");
    if (!keys[event.key] || event.ctrlKey || event.altKey || event.metaKey || isForButton) return;
    event.preventDefault();
    keys[event.key](event);
  });
}

/** Begin as the address says: #time=1.6&camera=rear&theme=dark&run=1. */
function fromAddress(viewer, count) {
  const said = new URLSearchParams(location.hash.slice(1));
  if (["light", "dark"].includes(said.get("theme"))) viewer.paint(said.get("theme"));
  if (["chase", "rear", "top", "free"].includes(said.get("camera"))) viewer.use(said.get("camera"));
  const run = Number(said.get("run") || 1) - 1;
  if (Number.isInteger(run) && run >= 0 && run < count) viewer.choose(run);
  if (said.has("time") && Number.isFinite(Number(said.get("time")))) viewer.seek(Number(said.get("time")));
}

main();
