/**
 * The argument of a command, by what it is: one of several names, as flags with their colours; a
 * set of names; a number with its unit, speeds in the operator's own.
 */
// SPDX-License-Identifier: Apache-2.0
import { colourOfFlag } from "../../view/shown";
import { speedUnit } from "../../view/speed_unit";
import { unitText } from "../../view/format";
import type { CommandInfo } from "../../wire/messages";

/** The base's mark of a value that means nothing. */
const kNoValue = "-";

export const isSet = (info: CommandInfo): boolean => info.unit === "bits";

/** What can be chosen: each value with its name. */
export function choicesOf(info: CommandInfo): { value: number; name: string }[] {
  return (info.labels ?? [])
    .map((name, i) => ({ value: isSet(info) ? 2 ** i : i, name }))
    .filter(({ name }) => name !== kNoValue);
}

const has = (value: number, bit: number): boolean => Math.floor(value / bit) % 2 === 1;

export interface ArgumentProps {
  info: CommandInfo;
  /** As it is written; of names the number of the one, or the sum of the bits. */
  text: string;
  onText: (text: string) => void;
}

function Choice({ info, text, onText }: ArgumentProps) {
  const value = Number(text);
  return (
    <div class="choices" role={isSet(info) ? "group" : "radiogroup"} aria-label="argument">
      {choicesOf(info).map((choice) => (
        <label class="choice" key={choice.name} data-flag={colourOfFlag(choice.name)}>
          <input
            type={isSet(info) ? "checkbox" : "radio"}
            name={`argument of ${info.name}`}
            checked={isSet(info) ? has(value, choice.value) : text === String(choice.value)}
            onChange={() =>
              onText(
                String(
                  isSet(info)
                    ? has(value, choice.value)
                      ? value - choice.value
                      : value + choice.value
                    : choice.value,
                ),
              )
            }
          />
          <i class="cloth" aria-hidden="true" />
          {choice.name}
        </label>
      ))}
      {isSet(info) && <span class="sum">{value === 0 ? "none is excluded" : ""}</span>}
    </div>
  );
}

export function Argument(props: ArgumentProps) {
  const { info, text, onText } = props;
  if (choicesOf(info).length > 0) return <Choice {...props} />;
  const isSpeed = info.unit === "m/s";
  const factor = isSpeed ? speedUnit.value.perMps : 1;
  return (
    <label class="amount">
      <input
        type="number"
        aria-label="argument"
        required
        value={text}
        min={info.min * factor}
        max={Math.floor(info.max * factor)}
        step={isSpeed ? 1 : info.resolution}
        onInput={(e) => onText(e.currentTarget.value)}
      />
      <span class="unit">{isSpeed ? speedUnit.value.name : unitText(info.unit)}</span>
    </label>
  );
}
