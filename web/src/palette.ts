// SPDX-License-Identifier: Apache-2.0
// Colours of scene and plots; the light ones are those of the pictures that the program draws (report/colours.hpp).
// Those that meet in one picture differ also to the colour-blind and in a grey print: tests/unit/palette.test.mjs.

export type Theme = 'light' | 'dark';

/** Colours as 0xrrggbb. */
export interface Palette {
  ground: number; // around the map
  paper: number; // the free space
  ink: number;
  faint: number; // secondary text and lines
  wall: number;
  wallEdge: number;
  obstacle: number;
  swarm: number; // and many robots
  trail: number; // the path travelled
  path: number; // the path planned
  tree: number;
  circle: number; // detection circles of a plan, and its local target
  start: number;
  goal: number;
  team: number; // branch of the team of a gathering
  input: number; // that all robots get
  radar: {
    kept: number;
    obstacle: number; // a direction that an obstacle screens
    wall: number;
    turn: number;
    chosen: number;
    detection: number;
    safety: number;
    prediction: number;
    alpha: [number, number, number, number]; // of kept, obstacle, wall, turn
  };
  prediction: number; // obstacles as predicted
  robots: number[]; // few robots, in order, and curves
  regions: number[]; // of a gathering, in order; robots are on them
  heat: number[]; // from low to high: cividis
}

const heat = [0x00224e, 0x35456c, 0x666970, 0x948e77, 0xc8b866, 0xfee838];

const light: Palette = {
  ground: 0xeef0f3,
  paper: 0xffffff,
  ink: 0x21262e,
  faint: 0x5c6470,
  wall: 0xccd1d9,
  wallEdge: 0x737a87,
  obstacle: 0xd55e00,
  swarm: 0x006e52,
  trail: 0x56b4e9,
  path: 0x00376e,
  tree: 0x838d9a,
  circle: 0xb83a86,
  start: 0x21262e,
  goal: 0x8a3fd1,
  team: 0xfad680,
  input: 0x21262e,
  radar: {
    kept: 0x56b4e9,
    obstacle: 0xc2489a,
    wall: 0x2f353d,
    turn: 0xf0d800,
    chosen: 0x000000,
    detection: 0x4d3310,
    safety: 0xe69f00,
    prediction: 0xdb5245,
    alpha: [0.85, 0.75, 0.7, 0.75],
  },
  prediction: 0xd55e00,
  robots: [0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x332288, 0x6b6b6b],
  regions: [0x0072b2, 0xd55e00, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x7a7a7a],
  heat,
};

const dark: Palette = {
  ground: 0x0d1013,
  paper: 0x181c22,
  ink: 0xe8ebef,
  faint: 0x9aa4b1,
  wall: 0x3d4651,
  wallEdge: 0x8b95a3,
  obstacle: 0xf07f32,
  swarm: 0x5fe0b8,
  trail: 0x2f7abd,
  path: 0x8cc4f5,
  tree: 0x56616e,
  circle: 0xe07db3,
  start: 0xe8ebef,
  goal: 0xf7e27a,
  team: 0x6e5c26,
  input: 0xe8ebef,
  radar: {
    kept: 0x56b4e9,
    obstacle: 0xd45aa0,
    wall: 0x6b7480,
    turn: 0xfff07a,
    chosen: 0xffffff,
    detection: 0xffe2c0,
    safety: 0xe6a817,
    prediction: 0xe8553f,
    alpha: [0.85, 0.75, 0.4, 0.9],
  },
  prediction: 0xf07f32,
  robots: [0x4aa0e6, 0xf07f32, 0x5fe0b8, 0xf0a8d0, 0xf0d060, 0x2f5fb8, 0xffffff, 0x858c95],
  regions: [0x4aa0e6, 0xf07f32, 0xf0a8d0, 0xf0d060, 0x2f5fb8, 0x858c95],
  heat,
};

export const palettes: Record<Theme, Palette> = { light, dark };

/** The theme preferred by the system. */
export function preferredTheme(): Theme {
  return matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}

/** A colour in CSS form. */
export function css(colour: number): string {
  return `#${colour.toString(16).padStart(6, '0')}`;
}

/** The colour at `share` in [0, 1] of evenly spaced stops. */
export function between(stops: number[], share: number): number {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(place), stops.length - 2);
  return mixed(stops[i]!, stops[i + 1]!, place - i);
}

/** Mixes `a` with a share of `b`. */
export function mixed(a: number, b: number, share: number): number {
  const channel = (shift: number) => {
    const from = (a >> shift) & 255;
    return Math.round(from + share * (((b >> shift) & 255) - from)) << shift;
  };
  return channel(16) | channel(8) | channel(0);
}
