// SPDX-License-Identifier: Apache-2.0
// Messages between the page and a session: docs/reference/lab-protocol.md.
import { decode } from 'cborg';

export type Point = [number, number];

/** A byte string of little-endian numbers, as in the messages. */
export type Bytes = Uint8Array;

export interface PolygonBody {
  outer: Bytes;
  holes: Bytes[];
  number: number;
}
/** Solids: discs as x, y, radius, number each, and polygons. */
export interface Bodies {
  discs: Bytes;
  polygons: PolygonBody[];
}

/** A scenario as in its file: keys with units. */
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type Scenario = { [key: string]: Json };

export interface Hello {
  type: 'hello';
  name: string;
  command: string;
  settings: string[]; // KEY=VALUE that it was opened with
  rig: string;
  playback: boolean;
  scenario: Scenario;
  changeable: string[];
  map: { lo: Point; hi: Point; walls: Bodies };
}

/** The scenario after a change while it runs. */
export interface Changed {
  type: 'scenario';
  scenario: Scenario;
}

export interface Radar {
  centre: Point;
  radius: number;
  prediction: number;
  safety: number;
  detection: number;
  step: number;
  beams: Bytes; // heading [rad], fate (0 kept, 1 obstacle, 2 wall, 3 turn), score each
  best?: number;
  straight?: number;
}

export interface Frame {
  type: 'frame';
  number: number;
  frame: { [key: string]: Json };
  holding: boolean;
  bodies: Bodies;
  robots: Bytes;
  path: Bytes;
  plans: number;
  target?: Point;
  radar?: Radar;
}

export interface Plan {
  type: 'plan';
  plans: number;
  nodes: Bytes;
  parents: Bytes;
  detections: Bytes;
}

export interface Aggregation {
  type: 'aggregation';
  nodes: Bytes;
  next: Bytes;
  region: Bytes;
  branch: Bytes;
  regions: { junction: Point; gate: number; next: number; branches: number }[];
}

/** Distances to the nearest wall or border at the middles of square cells, row by row from below. */
export interface Clearance {
  type: 'clearance';
  lo: Point;
  cell: number;
  columns: number;
  rows: number;
  values: Bytes;
}

export interface RunEvent {
  t_s: number;
  kind: string;
  x_um: number;
  y_um: number;
  clearance_um: number | null;
  body: number;
}

/** Numbers of ticks for plots: all so far if `anew`, else those since the last such message. */
export interface Rows {
  type: 'rows';
  anew: boolean;
  columns: string[];
  rows: Bytes;
  events: RunEvent[];
}

export interface Standing {
  type: 'standing';
  plays: boolean;
  speed: number;
  looks_back: boolean;
  frame: number;
  frames: number;
  ended: boolean;
  mode: 'autonomous' | 'manual' | 'hold';
  changes: string[];
  status: string;
  state: string;
  metrics: { [key: string]: Json };
  trouble: string;
}

export interface Answer {
  type: 'answer';
  id: number;
  issues: { keys: string[]; text: string }[];
}

export type Message = Hello | Changed | Frame | Plan | Aggregation | Clearance | Rows | Standing | Answer;

export type Request =
  | { do: 'play' | 'pause' | 'step' | 'live' | 'end' | 'clearance' }
  | { do: 'speed' | 'seek'; number: number }
  | { do: 'set'; key: string; value: string }
  | { do: 'restart'; settings: string[] }
  | { do: 'hold' | 'manual'; on: boolean }
  | { do: 'steer'; heading: number; speed: number };

export function read(bytes: ArrayBuffer): Message {
  return decode(new Uint8Array(bytes)) as Message;
}

/** The numbers in a byte string; copied, because its place in the message is not aligned. */
export function floats(bytes: Bytes): Float32Array {
  return new Float32Array(bytes.slice().buffer);
}
export function doubles(bytes: Bytes): Float64Array {
  return new Float64Array(bytes.slice().buffer);
}
export function indices(bytes: Bytes): Uint32Array {
  return new Uint32Array(bytes.slice().buffer);
}
