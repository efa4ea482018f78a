/**
 * Takes from a running base what its machine gives it, and gives it back: descriptors, memory, the
 * disk of its recording. Each function gives, or resolves with, what gives it back.
 */
// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, statfsSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pause } from "../console/rig.mjs";

const kMoreDescriptors = 40;
const kSettledMs = 1000;
const kFilling = 1 << 20;
/** With room for a whole run, so that it is full only when it is filled. */
const kDiskBytes = 2 ** 30;

const limit = (pid, what) => execFileSync("prlimit", [`--pid=${pid}`, what]);

async function descriptors({ pid }) {
  const count = () => readdirSync(`/proc/${pid}/fd`).length;
  let used = Infinity; // those of an earlier crowd are still being closed
  for (let now; (now = count()) < used; await pause(kSettledMs)) used = now;
  limit(pid, `--nofile=${used + kMoreDescriptors}:`);
  return () => limit(pid, "--nofile=1024:");
}

/** So many times what it has in memory now; what it only has reserved counts as it is. */
const memory =
  (times) =>
  ({ pid }) => {
    const status = readFileSync(`/proc/${pid}/status`, "utf8");
    const bytes = (name) =>
      Number(new RegExp(`^${name}:\\s+(\\d+) kB$`, "m").exec(status)[1]) * 1024;
    const allowed = bytes("VmData") + (times - 1) * bytes("VmRSS");
    limit(pid, `--data=${Math.round(allowed)}:`);
    return () => limit(pid, "--data=unlimited:");
  };

/** A file in the way of the recording, until the disk takes nothing more. */
function disk(process, folder) {
  const file = join(folder, "full");
  const zeros = Buffer.alloc(kFilling);
  try {
    for (;;) writeFileSync(file, zeros, { flag: "a" });
  } catch (error) {
    if (error.code !== "ENOSPC") throw error;
  }
  return () => rmSync(file);
}

export const kLimits = {
  descriptors,
  memory: memory(1.5),
  little_memory: memory(1.1),
  disk,
};

/** A small disk of its own for a recording; this process has mounts of its own. */
export function smallDisk(folder) {
  mkdirSync(folder);
  execFileSync("mount", ["-t", "tmpfs", "-o", `size=${kDiskBytes}`, "tmpfs", folder]);
  const { blocks, bsize } = statfsSync(folder);
  if (blocks * bsize > kDiskBytes) throw new Error(`${folder}: no small disk was mounted`);
  return () => execFileSync("umount", ["-l", folder]);
}
