// Time: which moment of an episode is shown.

import type { Episode } from "./messages";

const STEP_S = 0.1;
/** How long a stop of play and the end are shown, seconds. */
const STOP_S = 1;

export class Clock {
  private episode: Episode | null = null;
  private at = 0;
  private share = 0;
  private held = 0;
  playing = false;
  speed = 1;

  load(episode: Episode, play: boolean): void {
    this.episode = episode;
    [this.at, this.share, this.held, this.playing] = [0, 0, 0, play];
  }

  get last(): number {
    return Math.max(0, (this.episode?.scenes.length ?? 1) - 1);
  }

  get now(): { at: number; share: number } {
    return { at: this.at, share: this.share };
  }

  go(at: number): void {
    this.at = Math.min(Math.max(0, at), this.last);
    [this.share, this.held] = [0, 0];
  }

  toggle(): void {
    this.playing = !this.playing;
    if (this.playing && this.at >= this.last) this.go(0);
  }

  /** Goes on by this many seconds. */
  pass(seconds: number): void {
    const scenes = this.episode?.scenes;
    if (!this.playing || !scenes) return;
    let left = seconds * this.speed;
    while (left > 0) {
      if (this.at >= this.last) {
        this.playing = false;
        return;
      }
      if (scenes[this.at + 1]?.placed) {
        const rest = STOP_S - this.held;
        if (left < rest) {
          this.held += left;
          return;
        }
        left -= rest;
        this.at++;
        [this.share, this.held] = [0, 0];
        continue;
      }
      const rest = (1 - this.share) * STEP_S;
      if (left < rest) {
        this.share += left / STEP_S;
        return;
      }
      left -= rest;
      this.at++;
      this.share = 0;
    }
  }
}
