// SPDX-License-Identifier: Apache-2.0
import { Connection } from './connection';
import { type Answer, type Hello, type Message, type Request, type RigStanding, type RunEvent, type Standing, doubles } from './protocol';

type Listener = (message: Message) => void;

/** Numbers of all ticks so far, a list for each column, and events. */
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

  /** Index of the frame nearest to a time. */
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

/** State of a session in this page: the last messages and the numbers so far. */
export class Live {
  hello: Hello | undefined;
  standing: Standing | undefined;
  rig: RigStanding | undefined;
  readonly history = new History();
  /** Time shown by the scene, and time under the pointer on a plot or the time line [s]. */
  shown = 0;
  pointed: number | undefined;
  /** Whether the session was changed or steered manually since its start. */
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

  /** Starts the stream, once all listeners are registered. */
  open(): void {
    this.connection = new Connection(this.session, () => {
      for (const one of this.closers) one();
    });
    this.connection.listen((message) => this.take(message));
  }

  /** Registers a listener, called with every message after the state was updated. */
  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** Registers a listener for the end of the stream, unless by close(). */
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

  /** Seeks a frame; while a request is pending only the last one is kept. */
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
