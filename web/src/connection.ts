// SPDX-License-Identifier: Apache-2.0
import type { Answer, Message, Request } from './protocol';
import { type StreamState, verdictOf } from './reconnect';

const gone = 'The lab has ended or cannot be reached. Start it again and open the address that it prints.';

/** Sends a request to the server; an error has the server's text. */
export async function call<T>(method: 'GET' | 'POST' | 'DELETE', path: string, body?: unknown): Promise<T> {
  const response = await fetch(path, {
    method,
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  }).catch(() => {
    throw new Error(gone);
  });
  const json = await response.json();
  if (!response.ok) throw new Error(json.error ?? response.statusText);
  return json as T;
}

/** Status with which the server answers for a session; undefined if it does not. */
export async function statusOf(session: number): Promise<number | undefined> {
  try {
    return (await fetch(`/api/sessions/${session}`, { signal: AbortSignal.timeout(5000) })).status;
  } catch {
    return undefined;
  }
}

/** Throws an Error unless the session is open. */
export async function requireOpen(session: number): Promise<void> {
  const status = await statusOf(session);
  if (status !== 200) throw new Error(verdictOf(status, 'This run').text);
}

/** Messages of a session, and requests to it. Behind it is the stream of a server, a file or a worker. */
export interface Connection {
  /** Registers a listener for all messages from the hello on. */
  listen(listener: (message: Message) => void): void;
  /** Sends a request; the answer lists its issues, if any. */
  ask(request: Request): Promise<Answer>;
  /** Sends a request that has no answer. */
  tell(request: Request): void;
  close(): void;
}

/** Opens a connection, which says `onState` when it opens, breaks or is gone, with what to say of it. */
export type Connect = (onState: (state: StreamState, text: string) => void) => Connection;
