// SPDX-License-Identifier: Apache-2.0
import { Connection } from './connection';
import { type Answer, type Hello, type Message, type Request, type RigStanding, type RunEvent, type Standing, doubles } from './protocol';

type Listener = (message: Message) => void;

/** Numbers of all ticks so far, a list for each column, and the events. */
export class History {
  readonly columns = new Map<string, number[]>();
  events: RunEvent[] = [];

  column(name: string): number[] {
    return this.columns.get(name) ?? [];
  }

  get times(): number[] {
    return this.column('t_s');
  }

  take(names: string[], numbers: Float64Array, events: RunEvent[], anew: boolean): void {
    if (anew) {
      this.columns.clear();
      this.events = [];
    }
    names.forEach((name, at) => {
      const list = this.columns.get(name) ?? [];
      this.columns.set(name, list);
      for (let i = at; i < numbers.length; i += names.length) list.push(numbers[i] as number);
    });
    this.events.push(...events);
  }

  /** Number of the frame nearest to a time. */
  nearest(time: number): number {
    const times = this.times;
    let lo = 0;
    let hi = times.length - 1;
    while (lo < hi) {
      const middle = (lo + hi) >> 1;
      if ((times[middle] as number) < time) lo = middle + 1;
      else hi = middle;
    }
    const before = times[lo - 1];
    return before !== undefined && time - before < (times[lo] as number) - time ? lo - 1 : lo;
  }
}

/** A session as this page knows it: what was said last, and the numbers so far. */
export class Live {
  hello: Hello | undefined;
  standing: Standing | undefined;
  rig: RigStanding | undefined;
  readonly history = new History();
  /** Time that the scene shows, and where the pointer is on a plot or the time line [s]. */
  shown = 0;
  pointed: number | undefined;
  /** Whether it was changed or steered by a person since it began. */
  isTouched = false;
  private connection: Connection | undefined;
  private readonly listeners: Listener[] = [];
  private readonly pointers: (() => void)[] = [];
  private readonly closers: (() => void)[] = [];
  private wanted: number | undefined;
  private seeks = false;

  constructor(
    readonly session: number,
    onClose: () => void,
  ) {
    this.closers.push(onClose);
  }

  /** Begins, when everybody listens who wants to. */
  open(): void {
    this.connection = new Connection(this.session, () => {
      for (const one of this.closers) one();
    });
    this.connection.listen((message) => this.take(message));
  }

  /** Hears every message after the state here has taken it. */
  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** The stream has ended, and not by close(). */
  onClose(listener: () => void): void {
    this.closers.push(listener);
  }

  onPoint(listener: () => void): void {
    this.pointers.push(listener);
  }

  point(time: number | undefined): void {
    this.pointed = time;
    for (const one of this.pointers) one();
  }

  ask(request: Request): Promise<Answer> {
    if (!this.connection) return Promise.reject(new Error('The session is not open.'));
    return this.connection.ask(request);
  }

  tell(request: Request): void {
    this.connection?.tell(request);
  }

  /** Looks at a frame; of many wishes while the server answers only the last is sent. */
  seek(frame: number): void {
    const last = this.history.times.length - 1;
    this.wanted = Math.max(0, Math.min(last, Math.round(frame)));
    if (!this.seeks) void this.sendSeeks();
  }

  toggle(): void {
    void this.ask({ do: this.standing?.plays ? 'pause' : 'play' });
  }

  close(): void {
    this.connection?.close();
  }

  private async sendSeeks(): Promise<void> {
    this.seeks = true;
    while (this.wanted !== undefined) {
      const number = this.wanted;
      this.wanted = undefined;
      await this.ask({ do: 'seek', number });
    }
    this.seeks = false;
  }

  private take(message: Message): void {
    if (message.type === 'hello') this.hello = message;
    if (message.type === 'scenario' && this.hello) this.hello.scenario = message.scenario;
    if (message.type === 'standing') this.standing = message;
    if (message.type === 'rows' && message.anew) this.isTouched = false;
    if (message.type === 'standing') this.isTouched ||= message.changes.length > 0 || message.mode !== 'autonomous';
    if (message.type === 'rig') this.rig = message;
    if (message.type === 'frame') this.shown = Number(message.frame['t_s']);
    if (message.type === 'rows')
      this.history.take(message.columns, doubles(message.rows), message.events, message.anew);
    for (const listener of this.listeners) listener(message);
  }
}
