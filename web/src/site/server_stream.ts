// SPDX-License-Identifier: Apache-2.0
import type { Connection } from '../connection';
import { type Answer, type Message, type Request, read } from '../protocol';
import type { StreamState } from '../reconnect';
import { lab } from './lab';

/** The messages of a session of the worker, in place of the server's stream. */
export class ServerStream implements Connection {
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private readonly listeners: ((message: Message) => void)[] = [];
  private next = 1;
  private readonly leave: () => void;

  constructor(
    private readonly session: number,
    _: string,
    onState: (state: StreamState, text: string) => void,
  ) {
    this.leave = lab.join(session, (bytes) => this.take(read(bytes)));
    queueMicrotask(() => onState('open', ''));
  }

  listen(listener: (message: Message) => void): void {
    this.listeners.push(listener);
  }

  ask(request: Request): Promise<Answer> {
    const id = this.next++;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      void lab.call('ask', this.session, { id, ...request });
    });
  }

  tell(request: Request): void {
    void lab.call('ask', this.session, request);
  }

  close(): void {
    this.leave();
  }

  private take(message: Message): void {
    if (message.type === 'hello') {
      const { name } = message; // from the folder / of the module
      message.name = name.slice(1);
      message.command = message.command.replace(name, message.name);
    }
    if (message.type === 'answer') {
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    }
    for (const listener of this.listeners) listener(message);
  }
}
