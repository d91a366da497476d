// SPDX-License-Identifier: Apache-2.0
import { Container } from 'pixi.js';
import type { Palette } from '../palette';
import type { Message, Request } from '../protocol';
import type { Moment } from './motion';
import type { View } from './view';

/** What a layer draws from, besides the messages it took. */
export interface Drawing {
  view: View;
  now: Moment;
  colours: Palette;
}

/** What else than its messages a layer is drawn anew for. */
export interface Occasions {
  zoom?: boolean;
  motion?: boolean;
}

/** One thing that can be shown or not. It is drawn only when something changed. */
export abstract class Layer {
  abstract readonly name: string;
  abstract readonly label: string;
  readonly occasions: Occasions = {};
  readonly world = new Container(); // in µm, y up
  readonly screen = new Container(); // in pixels, above all worlds
  shown = true;
  /** Over a camera's picture, what it marks is seen through it. */
  readonly isSeenThrough: boolean = false;

  /** Takes from a message what concerns the layer; whether it is to be drawn anew. */
  abstract take(message: Message): boolean;
  abstract draw(drawing: Drawing): void;
  /** Called before each picture, for what keeps its shape but not its place. */
  place(_drawing: Drawing): void {}
  /** What the layer asks the session for before it can be drawn. */
  wants(): Request | undefined {
    return undefined;
  }
}
