/** Follows a running simulator: takes what is added to its run, and shows the newest of it. */

/** s: how far the time shown stays behind the newest sample, so that updates need not be punctual. */
const DELAY = 0.2;
/** s: beyond this the time shown jumps to the newest sample. */
const MOST_DELAY = 1;
/** 1/s: how fast a deviation from DELAY is made up. */
const CATCHING_UP = 2;
/** ms: time after which a page that was refused its updates is loaded again. */
const AGAIN = 1000;

class Feed {
  constructor(page, { address, page: name }) {
    Object.assign(this, { page, name });
    const source = new EventSource(address);
    source.onmessage = ({ data }) => this.take(JSON.parse(data));
    source.onopen = () => this.tell("");
    source.onerror = () => {
      this.tell("Connection lost. Waiting for it to come back.");
      if (source.readyState === EventSource.CLOSED) setTimeout(() => location.reload(), AGAIN);
    };
    this.button = $("live");
    this.button.hidden = false;
    this.button.addEventListener("click", () => this.follow());
    page.playback.isLive = true;
    page.playback.rate = () => this.rate();
    this.follow();
  }

  /** Show the newest samples from now on, until another time is chosen. */
  follow() {
    const { playback } = this.page;
    playback.seek(playback.range[1] - DELAY);
    playback.play(true);
    playback.isFollowing = true;
    this.button.setAttribute("aria-pressed", "true");
  }

  /** How fast the time shown advances, in real time. */
  rate() {
    const { playback } = this.page, behind = playback.range[1] - playback.time;
    this.button.setAttribute("aria-pressed", String(playback.isFollowing));
    return playback.isFollowing ? Math.max(1 + CATCHING_UP * (behind - DELAY), 0) : playback.speed;
  }

  take(told) {
    if (told.page !== this.name) return location.reload();
    const [run] = this.page.recordings, { playback } = this.page;
    if (told.run === this.run) run.append(told);
    else run.hold(told);
    this.run = told.run;
    this.page.renew(told.road);
    const [begin, end] = playback.range, isOutside = playback.time < begin || playback.time > end;
    if (playback.isFollowing && (isOutside || end - playback.time > MOST_DELAY)) this.follow();
    else if (isOutside) playback.seek(playback.time);
  }

  tell(text) {
    $("connection").textContent = text;
  }
}
