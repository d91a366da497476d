// SPDX-License-Identifier: Apache-2.0
// Colours of scene and plots, as in the reports: those of Okabe and Ito, which are distinguishable
// with any kind of colour blindness.

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
  swarm: number;
  trail: number;
  path: number;
  tree: number;
  circle: number; // detection circles of a plan, and its local target
  start: number;
  goal: number;
  radar: {
    kept: number;
    obstacle: number;
    wall: number;
    turn: number;
    chosen: number;
    detection: number;
    safety: number;
    prediction: number;
  };
  series: number[]; // robots, regions, curves; in order
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
  swarm: 0x009e73,
  trail: 0x0072b2,
  path: 0x0072b2,
  tree: 0x8cb3d9,
  circle: 0xcc79a7,
  start: 0x21262e,
  goal: 0x6640a6,
  radar: {
    kept: 0x56b4e9,
    obstacle: 0xd55e00,
    wall: 0x8b929c,
    turn: 0xe69f00,
    chosen: 0x004c99,
    detection: 0x8c5926,
    safety: 0xe69f00,
    prediction: 0xcc2626,
  },
  series: [0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x664da6, 0x595959],
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
  swarm: 0x2bc596,
  trail: 0x56b4e9,
  path: 0x56b4e9,
  tree: 0x4d749a,
  circle: 0xe39cc4,
  start: 0xe8ebef,
  goal: 0xb69cf2,
  radar: {
    kept: 0x56b4e9,
    obstacle: 0xf07f32,
    wall: 0x79828d,
    turn: 0xe6b33c,
    chosen: 0xcfe8fa,
    detection: 0xc99a6b,
    safety: 0xf0b429,
    prediction: 0xff7b7b,
  },
  series: [0x56b4e9, 0xf07f32, 0x2bc596, 0xe39cc4, 0xf0b429, 0x3d8fd1, 0xb69cf2, 0xb8bec6],
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
