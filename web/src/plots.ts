// SPDX-License-Identifier: Apache-2.0
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { element } from './dom';
import type { Live } from './live';
import { onTheme } from './theme';

interface Plotted {
  column: string;
  title: string;
  factor: number;
}
const plotted: Plotted[] = [
  { column: 'clearance_um', title: 'Clearance [µm]', factor: 1 },
  { column: 'avoidance_cost', title: 'Avoidance cost δ', factor: 1 },
  { column: 'step_time_s', title: 'Step time [ms]', factor: 1000 },
  { column: 'goal_distance_um', title: 'Mean distance to the goal [µm]', factor: 1 },
];
const period = 200; // ms between updates
const height = 132;

const colours = ['--accent', '--bad']; // of the sessions

/** Plots over time of one or more sessions, with a common cursor. A click seeks that time. */
export class Plots {
  readonly root = element('div', { class: 'plots' });
  private plots: uPlot[] = [];
  private renewed = 0;
  private timer: number | undefined;
  private readonly stopTheme: () => void;
  private readonly observer = new ResizeObserver(() => this.resize());

  constructor(
    private readonly lives: Live[],
    private readonly seek: (time: number) => void,
  ) {
    this.stopTheme = onTheme(() => this.build());
    this.observer.observe(this.root);
    for (const live of lives) {
      live.listen((message) => {
        if (message.type === 'rows') this.renewSoon();
        if (message.type === 'frame') this.markShown();
      });
      live.onPoint(() => this.point(live.pointed));
    }
  }

  destroy(): void {
    this.stopTheme();
    this.observer.disconnect();
    window.clearTimeout(this.timer);
    for (const plot of this.plots) plot.destroy();
  }

  /** To be called when the plots become visible. */
  show(): void {
    this.resize();
    this.renew();
  }

  private build(): void {
    for (const plot of this.plots) plot.destroy();
    this.root.replaceChildren();
    this.plots = plotted.map((what) => this.make(what));
  }

  private make(what: Plotted): uPlot {
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const axis: uPlot.Axis = {
      stroke: colour('--faint'),
      grid: { stroke: colour('--line'), width: 1 },
      ticks: { show: false },
      font: '11px system-ui, sans-serif',
      size: 22,
    };
    const options: uPlot.Options = {
      width: Math.max(200, this.root.clientWidth),
      height,
      title: what.title,
      legend: { show: false },
      scales: {
        x: { time: false },
        y: {
          range: (_, lo, hi) =>
            lo === hi ? [Math.min(0, lo), Math.max(1, hi)] : (uPlot.rangeNum(lo, hi, 0.1, true) as [number, number]),
        },
      },
      cursor: { drag: { x: false, y: false }, y: false, points: { size: 6 } },
      axes: [
        { ...axis, values: (_, all) => all.map((one) => `${one} s`) },
        { ...axis, size: 46 },
      ],
      series: [
        {},
        ...this.lives.map((_, i) => ({
          stroke: colour(colours[i] ?? '--ink'),
          width: 1.5,
          points: { show: false },
          spanGaps: this.lives.length > 1, // at ticks of the other session only
        })),
      ],
      hooks: {
        setCursor: [(plot) => this.pointedAt(plot)],
        draw: [(plot) => this.drawShown(plot, colour('--ink'))],
      },
    };
    const plot = new uPlot(options, this.data(what), this.root);
    plot.over.addEventListener('click', () => {
      const time = pointed(plot);
      if (time !== undefined) this.seek(time);
    });
    plot.over.addEventListener('pointerleave', () => this.tell(undefined));
    return plot;
  }

  private data(what: Plotted): uPlot.AlignedData {
    const most = 2 * Math.max(200, this.root.clientWidth);
    const tables = this.lives.map(({ history }): uPlot.AlignedData =>
      history.digest(what.column).line(history.times, most, what.factor),
    );
    return tables.length === 1 ? (tables[0] as uPlot.AlignedData) : uPlot.join(tables);
  }

  private isInSight(): boolean {
    return this.root.clientWidth > 0;
  }

  private resize(): void {
    if (!this.isInSight()) return;
    for (const plot of this.plots) plot.setSize({ width: this.root.clientWidth, height });
  }

  private renewSoon(): void {
    if (this.timer !== undefined) return;
    const wait = Math.max(0, period - (performance.now() - this.renewed));
    this.timer = window.setTimeout(() => this.renew(), wait);
  }

  private renew(): void {
    this.timer = undefined;
    this.renewed = performance.now();
    if (!this.isInSight()) return;
    this.plots.forEach((plot, i) => plot.setData(this.data(plotted[i] as Plotted)));
  }

  private markShown(): void {
    if (!this.isInSight() || this.lives.some((live) => live.standing?.plays)) return;
    for (const plot of this.plots) plot.redraw(false, false);
  }

  /** Draws a line at the time shown by the scene. */
  private drawShown(plot: uPlot, colour: string): void {
    const x = plot.valToPos(Math.max(...this.lives.map((live) => live.shown)), 'x', true);
    const { left, top, width, height: high } = plot.bbox;
    if (!(x >= left && x <= left + width)) return;
    plot.ctx.save();
    plot.ctx.strokeStyle = colour;
    plot.ctx.lineWidth = window.devicePixelRatio;
    plot.ctx.beginPath();
    plot.ctx.moveTo(x, top);
    plot.ctx.lineTo(x, top + high);
    plot.ctx.stroke();
    plot.ctx.restore();
  }

  private pointedAt(plot: uPlot): void {
    if (!plot.over.matches(':hover')) return; // moved by point()
    const time = pointed(plot);
    if (time !== undefined) this.tell(time);
  }

  private tell(time: number | undefined): void {
    for (const live of this.lives) live.point(time);
  }

  /** Moves the cursor of all plots to the time under the pointer on a plot or the time line. */
  private point(time: number | undefined): void {
    if (!this.isInSight()) return;
    for (const plot of this.plots) {
      if (plot.over.matches(':hover')) continue;
      const left = time === undefined ? -10 : plot.valToPos(time, 'x');
      plot.setCursor({ left, top: time === undefined ? -10 : 10 });
    }
  }
}

/** Time under the pointer [s]. */
function pointed(plot: uPlot): number | undefined {
  const { idx } = plot.cursor;
  return idx == null ? undefined : plot.data[0][idx];
}
