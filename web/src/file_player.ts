// SPDX-License-Identifier: Apache-2.0
import type { Connection } from './connection';
import { type Answer, type Message, type Request, type Standing, doubles, read, type Bytes } from './protocol';
import type { StreamState } from './reconnect';
import { type RunFile, heldAt } from './run_file';

const period = 33; // ms between frames
const fastest = 10; // frames in a period, at the speed 0

/** Plays a run that is in the page. */
export class FilePlayer implements Connection {
  private readonly listeners: ((message: Message) => void)[] = [];
  private readonly sent = new Map<keyof RunFile, Bytes | undefined>();
  private readonly standing: Standing;
  private readonly times: number[];
  private at = 0; // time played up to [s]
  private until = Infinity;
  private last = 0; // time of the last advance [ms]
  private timer: number | undefined;

  constructor(
    private readonly run: RunFile,
    onState: (state: StreamState, text: string) => void,
  ) {
    this.standing = { ...(messageOf(run.standing) as Standing), plays: false, speed: 1, ended: false };
    this.times = timesOf(messageOf(run.rows));
    // After the caller has registered its listeners.
    window.setTimeout(() => {
      onState('open', '');
      for (const one of [run.hello, run.rows]) this.send(messageOf(one));
      this.show(0);
      this.tellStanding();
    });
  }

  listen(listener: (message: Message) => void): void {
    this.listeners.push(listener);
  }

  ask(request: Request): Promise<Answer> {
    const answer: Answer = { type: 'answer', id: 0, issues: [] };
    const { standing } = this;
    const end = this.run.frames.length - 1;
    switch (request.do) {
      case 'play':
        if (standing.ended) this.show(0);
        this.until = request.number || Infinity;
        this.setPlays(true);
        break;
      case 'pause':
        this.setPlays(false);
        break;
      case 'step':
        this.setPlays(false);
        this.show(standing.frame + 1);
        break;
      case 'speed':
        standing.speed = request.number;
        break;
      case 'seek':
        this.show(request.number);
        this.at = this.times[standing.frame] ?? 0;
        break;
      case 'live':
        this.show(end);
        break;
      case 'clearance':
        this.send(messageOf(this.run.clearance));
        break;
      default:
        answer.issues.push({ keys: [], text: 'This is a run in a file: it cannot be changed.' });
    }
    this.tellStanding();
    return Promise.resolve(answer);
  }

  tell(request: Request): void {
    void this.ask(request);
  }

  close(): void {
    window.clearInterval(this.timer);
  }

  private setPlays(plays: boolean): void {
    window.clearInterval(this.timer);
    this.standing.plays = plays;
    if (!plays) return;
    this.at = this.times[this.standing.frame] ?? 0;
    this.last = performance.now();
    this.timer = window.setInterval(() => this.advance(), period);
  }

  private advance(): void {
    const { standing, times } = this;
    if (standing.ended) {
      this.setPlays(false);
      this.tellStanding();
      return;
    }
    const now = performance.now();
    this.at += (standing.speed * (now - this.last)) / 1000;
    this.last = now;
    let frame = standing.frame + (standing.speed === 0 ? fastest : 0);
    if (standing.speed > 0) while (frame + 1 < times.length && (times[frame + 1] as number) <= this.at) ++frame;
    if (frame === standing.frame) return;
    this.show(frame);
    if (standing.ended || (times[standing.frame] ?? 0) >= this.until) this.setPlays(false);
    this.tellStanding();
  }

  /** Shows a frame, at most the last one, with what holds at it. */
  private show(wanted: number): void {
    const { run, standing } = this;
    const end = run.frames.length - 1;
    const frame = Math.max(0, Math.min(end, Math.round(wanted)));
    for (const name of ['scenario', 'plan', 'aggregation'] as const) {
      const held = heldAt(run[name], frame);
      if (held && this.sent.get(name) !== held) this.send(messageOf(held));
      this.sent.set(name, held);
    }
    standing.frame = frame;
    standing.ended = frame === end;
    this.send(messageOf(run.frames[frame] as Bytes));
  }

  private tellStanding(): void {
    this.send({ ...this.standing });
  }

  private send(message: Message): void {
    for (const listener of this.listeners) listener(message);
  }
}

function messageOf(bytes: Bytes): Message {
  return read(new Uint8Array(bytes).buffer);
}

function timesOf(message: Message): number[] {
  if (message.type !== 'rows') return [];
  const numbers = doubles(message.rows);
  const { length } = message.columns;
  return Array.from({ length: numbers.length / length }, (_, i) => numbers[i * length] as number);
}
