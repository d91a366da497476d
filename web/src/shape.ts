// SPDX-License-Identifier: Apache-2.0
import type { Json } from './protocol';

/** Shape of a scenario's form: the types of its objects and the lengths of its lists. Other values do not change it. */
export function shapeOf(value: Json): Json {
  if (Array.isArray(value)) return value.some((one) => one && typeof one === 'object') ? value.map(shapeOf) : 0;
  if (value === null || typeof value !== 'object') return value === null ? null : 0;
  return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, key === 'type' ? one : shapeOf(one)]));
}
