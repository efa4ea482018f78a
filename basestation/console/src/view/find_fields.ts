/**
 * Search for fields by words of their titles and paths.
 */
// SPDX-License-Identifier: Apache-2.0
import type { FieldInfo } from "../wire/messages";

/** Fields whose title and path hold every word, those that begin with the first word in front. */
export function findFields(info: readonly FieldInfo[], query: string): FieldInfo[] {
  const words = query
    .toLowerCase()
    .split(/[\s.]+/)
    .filter(Boolean);
  const hits = info.filter((f) => {
    const text = `${f.title} ${f.path}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  const first = words[0] ?? "";
  const rank = (f: FieldInfo) =>
    [f.title.toLowerCase(), f.path, f.name].some((text) => text.startsWith(first)) ? 0 : 1;
  return hits.sort((a, b) => rank(a) - rank(b));
}
