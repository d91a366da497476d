// SPDX-License-Identifier: Apache-2.0
import type { Connect, Connection } from './connection';
import { History } from './history';
import {
  type Answer,
  type Hello,
  type Message,
  type Request,
  type RigStanding,
  type Standing,
  doubles,
} from './protocol';
import type { StreamState } from './reconnect';
import { ServerStream } from './server_stream';

type Listener = (message: Message) => void;

/** State of a session in this page: the last messages and the numbers so far. */
export class Live {
  hello: Hello | undefined;
  standing: Standing | undefined;
  rig: RigStanding | undefined;
  /** Whether the session is gone. */
  isClosed = false;
  private heard = 0; // time of the last message [ms]
  readonly history = new History();
  /** Time shown by the scene, and time under the pointer on a plot or the time line [s]. */
  shown = 0;
  pointed: number | undefined;
  private connection: Connection | undefined;
  private readonly listeners: Listener[] = [];
  private readonly pointers: (() => void)[] = [];
  private readonly staters: ((state: StreamState, text: string) => void)[] = [];
  private wanted: number | undefined;
  private seeks = false;

  /** `what` names the session in texts. One that is at no server has the number 0 and its own `connect`. */
  constructor(
    readonly session: number,
    what: string,
    private readonly connect: Connect = (onState) => new ServerStream(session, what, onState),
  ) {}

  /** Whether the session was changed, held or steered by hand since its start. */
  get isTouched(): boolean {
    const { standing } = this;
    return (
      standing !== undefined && (standing.changes.length > 0 || standing.steered || standing.mode !== 'autonomous')
    );
  }

  /** Time since the last message, while a rig runs and so sends some; else 0 [s]. */
  get silence(): number {
    const runs = this.rig?.state === 'dry' || this.rig?.state === 'armed';
    return runs ? (performance.now() - this.heard) / 1000 : 0;
  }

  /** Starts the stream, once all listeners are registered. */
  open(): void {
    this.connection = this.connect((state, text) => {
      this.isClosed = state === 'closed';
      for (const one of this.staters) one(state, text);
    });
    this.connection.listen((message) => this.take(message));
  }

  /** Registers a listener, called with every message after the state was updated. */
  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** Registers a listener for the stream's state: opened, broken or gone, with what to say of it. */
  onState(listener: (state: StreamState, text: string) => void): void {
    this.staters.push(listener);
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
    this.heard = performance.now();
    if (message.type === 'hello') this.hello = message;
    if (message.type === 'scenario' && this.hello) this.hello.scenario = message.scenario;
    if (message.type === 'standing') this.standing = message;
    if (message.type === 'rig') this.rig = message;
    if (message.type === 'frame') this.shown = Number(message.frame['t_s']);
    if (message.type === 'rows')
      this.history.take(message.columns, doubles(message.rows), message.events, message.anew);
    for (const listener of this.listeners) listener(message);
  }
}
