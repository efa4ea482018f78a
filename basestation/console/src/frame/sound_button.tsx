/**
 * Sound of the alarms: off, on, muted for a minute.
 */
// SPDX-License-Identifier: Apache-2.0
import { pressSound, sound } from "./tones";

const kWords = { off: "Sound off", on: "Sound on", muted: "Muted 60 s" } as const;

export function SoundButton() {
  return (
    <button type="button" class="sound" data-sound={sound.value} onClick={pressSound}>
      {kWords[sound.value]}
    </button>
  );
}
