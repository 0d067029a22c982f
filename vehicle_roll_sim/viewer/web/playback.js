/** The time shown, how it advances, and what the keys and buttons do to it. */

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];
/** s: step of the arrow keys with shift. */
const LONG_STEP = 0.1;
/** s: length of the time line for a run of one sample. */
const SHORTEST_RUN = 1e-3;

class Playback {
  /** range: first and last time (s). stops: times of events. onTime: called with each new time. */
  constructor(range, stops, onTime) {
    Object.assign(this, { range, onTime });
    this.stopAt(stops);
    this.speed = 1;
    this.isLive = this.isFollowing = false;
    this.rate = () => this.speed;
    this.time = range[0];
    this.isPlaying = false;
    this.onPlay = () => {};
  }

  /** Let `stop` go to these times (s). */
  stopAt(times) {
    this.stops = [...new Set(times)].sort((a, b) => a - b);
  }

  /** Go to a time. */
  seek(time) {
    this.isFollowing = false;
    this.advance(time);
  }

  advance(time) {
    this.time = Math.min(Math.max(time, this.range[0]), this.range[1]);
    this.onTime(this.time);
  }

  play(isPlaying = !this.isPlaying) {
    if (isPlaying && this.time >= this.range[1] && !this.isLive) this.seek(this.range[0]);
    this.isPlaying = isPlaying;
    this.last = null;
    if (isPlaying) requestAnimationFrame((now) => this.frame(now));
    this.onPlay(isPlaying);
  }

  frame(now) {
    if (!this.isPlaying) return;
    const passed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    this.advance(this.time + this.rate() * passed);
    const isAtEnd = this.time >= this.range[1];
    if (isAtEnd && this.isLive) this.isFollowing = true;
    if (isAtEnd && !this.isLive) this.play(false);
    else requestAnimationFrame((next) => this.frame(next));
  }

  /** Go to the next or previous sample of a run. */
  step(run, direction) {
    this.play(false);
    const [k, share] = run.place(this.time), last = run.time.length - 1;
    const to = direction > 0 ? Math.min(k + 1, last) : Math.max(share ? k : k - 1, 0);
    this.seek(run.time[to]);
  }

  /** Go to the next or previous event. */
  stop(direction) {
    const ahead = this.stops.filter((each) => direction * (each - this.time) > 1e-9);
    if (ahead.length) this.seek(direction > 0 ? ahead[0] : ahead[ahead.length - 1]);
  }

  /** The next higher or lower speed. */
  change(direction) {
    const k = SPEEDS.indexOf(this.speed) + direction;
    this.speed = SPEEDS[Math.min(Math.max(k, 0), SPEEDS.length - 1)];
  }
}
