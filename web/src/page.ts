// SPDX-License-Identifier: Apache-2.0

/** A page in the window, and how it is left. */
export interface Page {
  root: HTMLElement;
  leave(): void;
}
