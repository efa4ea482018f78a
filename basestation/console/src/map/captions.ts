/**
 * Heights of the captions beside their marks on the strip: each in the nearest row above or below
 * its mark in which it covers no mark and no earlier caption; in the nearest row if all are taken.
 */
// SPDX-License-Identifier: Apache-2.0

/** A caption's centre and half width, and the height of its mark; pixels, downwards. */
export interface Caption {
  x: number;
  half: number;
  markY: number;
}
export interface Mark {
  x: number;
  y: number;
}

const kAbove = [-16, 17, -31, 32] as const;
const kBelow = [17, -16, 32, -31] as const;
const kHalfHeight = 7;
const kMarkHalf = 9;

/** Heights of the captions' centres, pixels; every second one looks for a row above first. */
export function captionHeights(
  captions: readonly Caption[],
  marks: readonly Mark[],
  height: number,
): number[] {
  const placed: (Caption & { y: number })[] = [];
  const isFree = ({ x, half }: Caption, y: number) =>
    y >= kHalfHeight &&
    y <= height - kHalfHeight &&
    !marks.some(
      (mark) =>
        Math.abs(mark.x - x) < half + kMarkHalf && Math.abs(mark.y - y) < kHalfHeight + kMarkHalf,
    ) &&
    !placed.some(
      (other) =>
        Math.abs(other.x - x) < half + other.half && Math.abs(other.y - y) < 2 * kHalfHeight,
    );
  return captions.map((caption, i) => {
    const rows = (i % 2 === 0 ? kAbove : kBelow).map((row) => caption.markY + row);
    const y = rows.find((row) => isFree(caption, row)) ?? rows[0]!;
    placed.push({ ...caption, y });
    return y;
  });
}
