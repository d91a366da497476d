// SPDX-License-Identifier: Apache-2.0

/** A page in the window, and the function that leaves it. */
export interface Page {
  root: HTMLElement;
  leave(): void;
}
