// SPDX-License-Identifier: Apache-2.0
// JSON Schema as written by `microswarm schema scenario`.
import type { Json } from './protocol';

export interface Schema {
  type?: string;
  const?: Json;
  enum?: string[];
  description?: string;
  default?: Json;
  minimum?: number;
  maximum?: number;
  properties?: { [key: string]: Schema };
  required?: string[];
  items?: Schema;
  oneOf?: Schema[];
  anyOf?: Schema[];
}

/** X of `anyOf` [X, null]; else the schema itself. */
export function withoutNull(schema: Schema): Schema {
  const inner = schema.anyOf?.find((one) => one.type !== 'null');
  return inner ? { ...inner, ...(schema.description ? { description: schema.description } : {}) } : schema;
}

export function allowsNull(schema: Schema): boolean {
  return schema.anyOf?.some((one) => one.type === 'null') ?? false;
}

/** Possible values of `type`. */
export function kinds(schema: Schema): string[] {
  return (schema.oneOf ?? []).map((one) => String(one.properties?.['type']?.const));
}

/** The alternative whose `type` the value has. */
export function alternative(schema: Schema, value: Json | undefined): Schema | undefined {
  const type = value && typeof value === 'object' && !Array.isArray(value) ? value['type'] : undefined;
  return schema.oneOf?.find((one) => one.properties?.['type']?.const === type);
}

export function isGroup(schema: Schema): boolean {
  const inner = withoutNull(schema);
  return inner.properties !== undefined || inner.oneOf !== undefined;
}

/** Splits a doc line into text and the unit in brackets at its end. */
export function described(schema: Schema): { doc: string; unit: string } {
  const found = /^(.*?)\s*(?:\[([^\]]+)\])?$/s.exec(schema.description ?? '');
  const unit = found?.[2] ?? '';
  const isUnit =
    /^[µ°a-zA-Z²³·/%^0-9−-]+$/.test(unit) && /µ|°|^(s|m|T|A|K|V|W|g|mT|Hz|kHz|1\/s|rad.*|px.*|%)/.test(unit);
  return isUnit ? { doc: found?.[1] ?? '', unit } : { doc: schema.description ?? '', unit: '' };
}

/** Position of a slider for a value, and back; logarithmic if the range spans decades. */
export interface Range {
  toShare(value: number): number;
  toValue(share: number): number;
}

/** Range of a value's slider: up to ten times the default and up to `most`, where the schema allows more. The default is in it. */
export function rangeOf(schema: Schema, most = Infinity): Range | undefined {
  const { minimum: lo, maximum } = schema;
  if (lo === undefined || maximum === undefined) return undefined;
  const usual = typeof schema.default === 'number' ? Math.abs(schema.default) : 0;
  const ten = usual > 0 && maximum > 20 * usual && lo >= 0 ? 10 * usual : maximum; // a span around the default
  const hi = Math.min(maximum, Math.max(Math.min(most, ten), usual));
  if (hi <= lo) return undefined;
  const isWhole = schema.type === 'integer';
  const whole = (value: number) => (isWhole ? Math.round(value) : value);
  const clamp = (value: number) => Math.max(lo, Math.min(hi, value));
  const spansDecades = lo >= 0 && hi >= 1000 * Math.max(lo, 1e-9) && (lo > 0 || hi > 100 * (usual || hi / 10));
  if (!spansDecades)
    return {
      toShare: (value) => (clamp(value) - lo) / (hi - lo),
      toValue: (share) => whole(Number((lo + share * (hi - lo)).toPrecision(3))),
    };
  // Zero, if allowed, is the slider's left end.
  const least = Math.max(lo, usual / 100) || (isWhole ? 1 : hi / 1e6);
  const zero = lo > 0 ? 0 : 0.03;
  const decades = Math.log(hi / least);
  return {
    toShare: (value) =>
      value <= 0 ? 0 : zero + (1 - zero) * Math.max(0, Math.min(1, Math.log(value / least) / decades)),
    toValue: (share) =>
      zero > 0 && share < zero / 2
        ? lo
        : whole(clamp(Number((least * Math.exp((Math.max(0, share - zero) / (1 - zero)) * decades)).toPrecision(3)))),
  };
}
