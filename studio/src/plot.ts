// What each term has paid up to each moment.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Episode } from "./messages";

const COLOURS = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#f0e442", "#7896ff"];

export class Plot {
  private plot: uPlot | null = null;
  private times: number[] = [];

  constructor(private readonly parent: HTMLElement, private readonly go: (at: number) => void) {
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(parent);
  }

  show(episode: Episode): void {
    const names = episode.scenes[0]?.rewards.map((term) => term.name) ?? [];
    const sums = names.map(() => 0);
    const curves: number[][] = names.map(() => []);
    const paid: number[][] = names.map(() => []);
    let step = 0;
    for (const scene of episode.scenes) {
      scene.rewards.forEach((term, index) => {
        // A stop and its restart are of one step, which pays once.
        const value = scene.step > step ? term.value : 0;
        if (value !== 0) paid[index]?.push(curves[index]?.length ?? 0);
        sums[index] = (sums[index] ?? 0) + value;
        curves[index]?.push(sums[index] ?? 0);
      });
      step = scene.step;
    }
    this.times = episode.scenes.map((scene) => scene.step / 10);
    const axis = { stroke: "#8996a5", grid: { stroke: "#8996a533" }, ticks: { show: false } };
    const options: uPlot.Options = {
      ...this.size(),
      scales: {
        x: { time: false },
        // Where nothing is paid, the line of 0 stands in the middle.
        y: { range: (_, least, most) => (least === most ? [least - 0.1, most + 0.1] : [least, most]) },
      },
      axes: [axis, axis],
      legend: { live: true },
      series: [
        { label: "s" },
        ...names.map((label, index) => ({
          label,
          // Each payment is a mark, unless nearly every step pays.
          points: { show: true, size: 7, filter: () => rare(paid[index] ?? []) },
          stroke: COLOURS[index % COLOURS.length] ?? "#ffffff",
          width: 2,
        })),
      ],
    };
    const rare = (at: number[]) => (at.length * 4 < this.times.length ? at : []);
    this.plot?.destroy();
    this.plot = new uPlot(options, [this.times, ...curves], this.parent);
    this.plot.over.addEventListener("click", () => this.go(this.plot?.cursor.idx ?? 0));
  }

  mark(at: number): void {
    if (!this.plot) return;
    const left = this.plot.valToPos(this.times[at] ?? 0, "x");
    this.plot.setCursor({ left, top: -10 }, false);
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(200, this.parent.clientWidth), height: 180 };
  }
}
