/** Buttons, keys, time line, and the settings in the address of the page. */

/** Buttons, keys and the time line. */
function bindControls(page) {
  const { playback } = page;
  const theme = () => page.paint(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  const change = (direction) => { playback.change(direction); $("speed").value = playback.speed; };
  const step = (direction, isLong) => (isLong
    ? playback.seek(playback.time + direction * LONG_STEP) : playback.step(page.followed, direction));
  $("scrub").addEventListener("input", (event) => playback.seek(Number(event.target.value)));
  $("play").addEventListener("click", () => playback.play());
  $("back").addEventListener("click", () => step(-1));
  $("forward").addEventListener("click", () => step(1));
  $("theme").addEventListener("click", theme);
  for (const each of SPEEDS) $("speed").append(new Option(`${each} ×`, each));
  $("speed").value = playback.speed;
  $("speed").addEventListener("change", (event) => { playback.speed = Number(event.target.value); });
  document.querySelectorAll("[data-camera]").forEach((each) =>
    each.addEventListener("click", () => page.use(each.dataset.camera)));
  document.querySelectorAll("[data-zoom]").forEach((each) =>
    each.addEventListener("click", () => page.plots.zoom(Number(each.dataset.zoom))));
  playback.onPlay = (isPlaying) => {
    $("play").classList.toggle("playing", isPlaying);
    $("play").setAttribute("aria-label", isPlaying ? "Pause" : "Play");
    if (!isPlaying) playback.seek(playback.time);
  };
  bindKeys(page, { theme, change, step });
}

/** Keys, except those that a focused list or button needs itself. */
function bindKeys(page, { theme, change, step }) {
  const { playback } = page;
  const keys = {
    " ": () => playback.play(), n: () => playback.stop(1), p: () => playback.stop(-1),
    ArrowLeft: (event) => step(-1, event.shiftKey), ArrowRight: (event) => step(1, event.shiftKey),
    Home: () => playback.seek(playback.range[0]), End: () => playback.seek(playback.range[1]),
    "+": () => change(1), "-": () => change(-1), t: theme,
    i: () => page.plots.zoom(4), o: () => page.plots.zoom(0.25),
    1: () => page.use("chase"), 2: () => page.use("rear"), 3: () => page.use("top"), 4: () => page.use("free"),
  };
  document.addEventListener("keydown", (event) => {
    const pressed = "button, summary, [type=checkbox], [role=button]";
    const isTaken = event.target.closest(event.key === " " ? `select, ${pressed}` : "select");
    if (!keys[event.key] || event.ctrlKey || event.altKey || event.metaKey || isTaken) return;
    event.preventDefault();
    keys[event.key](event);
  });
}

/** Apply the settings in the address: #time=1.6&camera=rear&theme=dark&run=1. */
function fromAddress(viewer, count) {
  const said = new URLSearchParams(location.hash.slice(1));
  if (["light", "dark"].includes(said.get("theme"))) viewer.paint(said.get("theme"));
  if (["chase", "rear", "top", "free"].includes(said.get("camera"))) viewer.use(said.get("camera"));
  const run = Number(said.get("run") || 1) - 1;
  if (Number.isInteger(run) && run >= 0 && run < count) viewer.choose(run);
  if (said.has("time") && Number.isFinite(Number(said.get("time")))) viewer.seek(Number(said.get("time")));
}
