// SPDX-License-Identifier: Apache-2.0
import { Container } from 'pixi.js';
import type { Palette } from '../palette';
import type { Message, Point, Request } from '../protocol';
import type { Entry, Said } from './key';
import type { Moment } from './motion';
import type { View } from './view';

/** Input of a layer besides its messages. */
export interface Drawing {
  view: View;
  now: Moment;
  colours: Palette;
}

/** Reasons besides messages for which a layer is redrawn. */
export interface Occasions {
  zoom?: boolean;
  motion?: boolean;
}

/** A part of the scene that can be shown or hidden. It is redrawn only after a change. */
export abstract class Layer {
  abstract readonly name: string;
  abstract readonly label: string;
  /** Meaning of its marks, in a sentence; empty if the label says it. */
  readonly help: string = '';
  readonly occasions: Occasions = {};
  readonly world = new Container(); // in µm, y up
  readonly screen = new Container(); // in pixels, above all worlds
  shown = true;
  /** Whether every experiment has it. */
  readonly isEverywhere: boolean = false;
  /** Whether the layer is translucent over a camera's picture. */
  readonly isSeenThrough: boolean = false;

  /** Takes the layer's data from a message; returns whether it must be redrawn. */
  abstract take(message: Message): boolean;
  abstract draw(drawing: Drawing): void;
  /** Called before each picture, to update positions of unchanged shapes. */
  place(_drawing: Drawing): void {}
  /** Entries of the legend; none as long as the experiment has none of these marks. */
  entries(_colours: Palette): Entry[] {
    return [];
  }
  /** Words on the mark of this layer at a position of the screen, if there is one. */
  say(_at: Point, _drawing: Drawing): Said | undefined {
    return undefined;
  }
  /** Request to the session that the layer needs before it can be drawn. */
  wants(): Request | undefined {
    return undefined;
  }
}
