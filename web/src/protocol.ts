// SPDX-License-Identifier: Apache-2.0
// Messages between the page and a session: docs/reference/lab-protocol.md.
import { decode } from 'cborg';

export type Point = [number, number];

/** A byte string of little-endian numbers. */
export type Bytes = Uint8Array;

export interface PolygonBody {
  outer: Bytes;
  holes: Bytes[];
  number: number;
}
/** Solids: discs as x, y, radius, number, and polygons. */
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
  settings: string[]; // KEY=VALUE given at opening
  rig: string;
  live: boolean; // on a rig in real time
  rig_info?: RigInfo; // of an open rig
  photo: { file: string; um_per_px: number } | null; // background, lower left corner at the origin
  playback: boolean;
  scenario: Scenario;
  changeable: string[];
  states: string[]; // words for the numbers in the column state of rows
  map: { lo: Point; hi: Point; walls: Bodies };
}

/** Properties of a rig. */
export interface RigInfo {
  name: string;
  coils: string[];
  real_coils: boolean;
  real_camera: boolean;
  max_current_a: (number | null)[];
  max_temperature_c: (number | null)[];
  field_mt: number;
  warnings: string[];
}

/** The scenario after a change during the run. */
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
  beams: Bytes; // heading [rad], fate (0 kept, 1 obstacle, 2 wall, 3 turn), score for each
  screens?: Bytes; // number of the obstacle that screens each beam, or −1
  best?: number;
  straight?: number;
}

/** Predicted obstacles. */
export interface Predicted {
  effect: number;
  radius: number; // of the swarm with its gap
  bodies: Bytes; // body, time, x, y, radius, uncertainty, turn, growth for each
  corners: Bytes; // of convex outlines, before they turn and grow: body, x, y for each; none for discs
}

/** State of a gathering; numbers from 0. */
export interface Gathering {
  mean_distance: number;
  livelock: boolean;
  leader?: number;
  region?: number; // of the team that is led
  branch?: number;
  moves_left?: number;
}

/** Decision of hierarchical D-RRT*. */
export interface Hierarchical {
  towards: Point;
  path_clearance: number;
  in_time: boolean;
  is_led: boolean;
  wait?: Point;
  wait_since?: number;
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
  predicted?: Predicted;
  gathering?: Gathering;
  hierarchical?: Hierarchical;
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

/** Distances to the nearest wall or border at the centres of square cells, row by row from below. */
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

/** Numbers of ticks for plots: all so far if `anew`, else those since the last message of this type. */
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
  growing: boolean; // a record that a run still writes
  mode: 'autonomous' | 'manual' | 'hold';
  steered: boolean; // held or steered by hand since the start
  changes: string[];
  status: string;
  state: string;
  metrics: { [key: string]: Json };
  decisions_every: number; // diagnostics are kept of every such frame
  trouble: string;
}

/** A camera's picture; the centre of pixel (u, v) is at x = a u + b v + c, y = d u + e v + f [µm]. */
export interface Picture {
  type: 'picture';
  t_s: number;
  width: number;
  height: number;
  to_um: [number, number, number, number, number, number];
  jpeg: Bytes;
}

/** Median, 95th and 99th percentile [ms]. */
export type Quantiles = [number, number, number];

/** State of a rig, and the numbers of its run if there is one. */
export interface RigStanding {
  type: 'rig';
  state: 'dry' | 'opening' | 'armed' | 'ended';
  why: string;
  zero_confirmed: boolean | null;
  stop_trouble: string;
  folder: string;
  t_s?: number;
  field_mt?: [number, number, number];
  currents_a?: number[];
  temperatures_c?: number[];
  scale?: number;
  device_scale?: number;
  sight?: string;
  robots?: number;
  unseen?: number;
  gap_um?: number | null;
  speed_um_per_s?: number;
  latency_ms?: {
    frame_age: Quantiles;
    vision: Quantiles;
    tick: Quantiles;
    camera_to_current: Quantiles;
    coil_late: Quantiles;
    round_trip: Quantiles;
  };
  ticks?: number;
  missed_deadlines?: number;
  late_currents?: number;
  frames?: number;
  dropped_frames?: number;
  frame_gaps?: number;
  unseen_frames?: number;
  resumed?: number;
  limited?: number;
  weakened?: number;
}

/** Whether this page has the controls of the rig, or no page has. */
export interface Controls {
  type: 'controls';
  holds: boolean;
  free: boolean;
  pages: number;
}

export interface Answer {
  type: 'answer';
  id: number;
  issues: Issue[];
}

/** One mistake. */
export interface Issue {
  /** Keys concerned, from the top of the scenario. */
  keys: string[];
  text: string;
  /** Place where the value was given, "flight.yaml:12:3"; empty for one that was just set. */
  place?: string;
  /** Value as written; empty if unknown. */
  value?: string;
  /** Allowed range or words; empty if unknown. */
  limit?: string;
}

/** The issues on one line. */
export function said(answer: Answer | undefined): string {
  return (answer?.issues ?? []).map((one) => (one.place ? `${one.place}: ${one.text}` : one.text)).join(' ');
}

export type Message =
  | Hello
  | Changed
  | Frame
  | Plan
  | Aggregation
  | Clearance
  | Rows
  | Standing
  | Picture
  | RigStanding
  | Controls
  | Answer;

export type Request =
  | { do: 'pause' | 'step' | 'live' | 'end' | 'clearance' | 'beat' | 'ping' | 'stop' | 'control' | 'arm' | 'dry' }
  | { do: 'play'; number?: number }
  | { do: 'speed' | 'seek'; number: number }
  | { do: 'set'; key: string; value: string }
  | { do: 'restart'; settings: string[] }
  | { do: 'hold' | 'manual'; on: boolean }
  | { do: 'steer'; heading: number; speed: number };

export function read(bytes: ArrayBuffer): Message {
  return decode(new Uint8Array(bytes)) as Message;
}

/** The numbers in a byte string, copied because it is not aligned in the message. */
export function floats(bytes: Bytes): Float32Array {
  return new Float32Array(bytes.slice().buffer);
}
export function doubles(bytes: Bytes): Float64Array {
  return new Float64Array(bytes.slice().buffer);
}
export function whole(bytes: Bytes): Int32Array {
  return new Int32Array(bytes.slice().buffer);
}
export function indices(bytes: Bytes): Uint32Array {
  return new Uint32Array(bytes.slice().buffer);
}
