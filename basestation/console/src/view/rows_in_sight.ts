/**
 * Which rows of a long list are in sight of its scrolling box: rows of one height, of which only
 * those in sight, and a few around them, exist.
 */
// SPDX-License-Identifier: Apache-2.0
import type { RefObject } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";

const kMostRows = 60;
const kExtraRows = 4;

export interface RowsInSight {
  first: number;
  count: number;
  /** Whole rows that the box has room for. */
  page: number;
  setTop: (px: number) => void;
}

export function useRowsInSight(box: RefObject<HTMLElement | null>, rowPx: number): RowsInSight {
  const [top, setTop] = useState(0);
  const [height, setHeight] = useState(600);
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const measure = () => setHeight(element.clientHeight);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return {
    first: Math.max(0, Math.floor(top / rowPx) - kExtraRows),
    count: Math.min(Math.ceil(height / rowPx) + 2 * kExtraRows, kMostRows),
    page: Math.floor(height / rowPx),
    setTop,
  };
}
