/**
 * The recordings that the base has, and what plays one. A replay is a process of its own without
 * any way to the car, so it is started at the base's machine and not from here.
 */
// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from "preact/hooks";
import { clockText, kDash } from "../../view/format";
import { TableHead } from "../../view/table_head";
import type { Recording, Recordings } from "../../wire/pit";

const kAgainMs = 10_000;
const kMegabyte = 1e6;

/** What the base has; a text where it does not say. */
async function fetchRecordings(): Promise<Recordings | string> {
  try {
    const answer = await fetch("api/recordings");
    if (answer.status === 204) return "This base was started without a folder of recordings.";
    if (!answer.ok) return (await answer.text()).trim() || `status ${answer.status}`;
    return (await answer.json()) as Recordings;
  } catch {
    return "The base does not answer.";
  }
}

export const dayText = (utcMs: number | null): string =>
  utcMs === null ? kDash : new Date(utcMs).toISOString().slice(0, 10);

export function sizeText(bytes: number): string {
  const megabytes = bytes / kMegabyte;
  return megabytes < 1000 ? `${megabytes.toFixed(1)} MB` : `${(megabytes / 1000).toFixed(2)} GB`;
}

function Command({ text }: { text: string }) {
  const [copied, setCopied] = useState(false);
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text);
      setCopied(true);
    } catch {
      setCopied(false); // a page that is not trusted with the clipboard: the text can be marked
    }
  };
  return (
    <div class="command-line">
      <input
        readOnly
        value={text}
        aria-label="command that plays it"
        onFocus={(e) => e.currentTarget.select()}
      />
      <button type="button" onClick={() => void copy()}>
        {copied ? "Copied" : "Copy"}
      </button>
    </div>
  );
}

/** From the begin of the first segment to that of the last. */
function spanText({ first_utc_ms, last_utc_ms }: Recording): string {
  if (first_utc_ms === null || last_utc_ms === null) return kDash;
  return `${clockText(first_utc_ms)} \u2013 ${clockText(last_utc_ms)}`;
}

function state(recording: Recording): string {
  if (recording.problem) return recording.problem;
  return recording.running ? "being recorded" : "";
}

interface RowProps {
  recording: Recording;
  chosen: boolean;
  onChosen: () => void;
}

function Row({ recording, chosen, onChosen }: RowProps) {
  return (
    <tr data-selected={chosen}>
      <th scope="row">
        <button type="button" aria-pressed={chosen} onClick={onChosen}>
          {recording.name}
        </button>
      </th>
      <td>
        {recording.car} {recording.car_name}
      </td>
      <td>
        {spanText(recording)}
        <br />
        <span class="begun">{dayText(recording.first_utc_ms)}</span>
      </td>
      <td>
        {sizeText(recording.bytes)}
        <br />
        <span class="begun">{recording.segments} segments</span>
      </td>
      <td>{state(recording)}</td>
    </tr>
  );
}

export function RecordingsPanel() {
  const [known, setKnown] = useState<Recordings | string>("");
  const [chosen, setChosen] = useState("");
  useEffect(() => {
    let gone = false;
    const ask = async () => {
      const found = await fetchRecordings();
      if (!gone) setKnown(found);
    };
    void ask();
    const timer = setInterval(() => void ask(), kAgainMs);
    return () => {
      gone = true;
      clearInterval(timer);
    };
  }, []);
  const list = typeof known === "string" ? null : known;
  const selected = list?.recordings.find((recording) => recording.folder === chosen);
  return (
    <section class="panel grows recordings" aria-label="recordings" tabIndex={0}>
      <h2>
        Recordings <span class="sum">{list?.root ?? ""}</span>
      </h2>
      {list === null && <p class="empty">{String(known)}</p>}
      {list?.problem && <p class="refused">{list.problem}</p>}
      {list !== null && list.recordings.length === 0 && (
        <p class="empty">Nothing has been recorded there yet.</p>
      )}
      {list !== null && list.recordings.length > 0 && (
        <table class="readings wide log">
          <TableHead names={["recording", "car", "UTC", "size", "state"]} />
          <tbody>
            {list.recordings.map((recording) => (
              <Row
                recording={recording}
                chosen={recording.folder === chosen}
                onChosen={() => setChosen(recording.folder)}
                key={recording.folder}
              />
            ))}
          </tbody>
        </table>
      )}
      {list !== null && list.left_out > 0 && (
        <p class="empty">{list.left_out} older ones are not listed.</p>
      )}
      {selected && !selected.problem && (
        <>
          <p>
            A replay has no way to the car: it is a process of its own, started in a terminal of the
            base's machine. It says at which address it shows {selected.name}.
          </p>
          <Command text={selected.command} key={selected.folder} />
        </>
      )}
    </section>
  );
}
