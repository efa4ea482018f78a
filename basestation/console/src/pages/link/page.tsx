/**
 * The link and its budget: loss, round trip, jitter and load of each path and direction over 1, 5
 * and 30 s, what each group costs and how old it gets, and messages for race control.
 */
// SPDX-License-Identifier: Apache-2.0
import * as session from "../../store/session";
import { AgeSince } from "../../view/age_since";
import { ageText, kDash } from "../../view/format";
import { TableHead } from "../../view/table_head";
import { Line } from "../../view/value";
import { BudgetPanel } from "./budget";
import { Notices } from "./notices";
import type { LinkPath, LinkWindow } from "../../wire/messages";

type WindowOf = LinkWindow & { seconds: number };

const figure = (value: number | null | undefined, scale = 1, decimals = 0): string =>
  typeof value === "number" && Number.isFinite(value) ? (value * scale).toFixed(decimals) : kDash;

function PathRows({ path }: { path: LinkPath }) {
  const windows = Array.isArray(path.windows) ? (path.windows as WindowOf[]) : [];
  return (
    <>
      {windows.map((w, i) => (
        <tr key={w.seconds}>
          {i === 0 && (
            <th scope="rowgroup" rowSpan={windows.length}>
              {path.path} {path.direction}
            </th>
          )}
          <td>{w.seconds} s</td>
          <td>{figure(w.loss, 100, 1)}</td>
          <td>{figure(w.rtt_ms, 1, 1)}</td>
          <td>{figure(w.jitter_ms, 1, 1)}</td>
          <td>{figure(w.reorder, 100, 1)}</td>
          <td>{figure(w.duplicate, 100, 1)}</td>
          <td>{figure(w.kbit_s, 1, 1)}</td>
          <td>{figure(w.cap_kbit_s)}</td>
        </tr>
      ))}
    </>
  );
}

function Paths() {
  const paths = session.link.value?.paths ?? [];
  return (
    <section class="panel" aria-label="paths" tabIndex={0}>
      <h2>Paths</h2>
      <table class="readings wide">
        <TableHead
          names={[
            "path",
            "over",
            "loss %",
            "round trip ms",
            "jitter ms",
            "reorder %",
            "twice %",
            "kbit/s",
            "cap",
          ]}
        />
        <tbody>
          {paths.map((path) => (
            <PathRows path={path} key={`${path.path} ${path.direction}`} />
          ))}
        </tbody>
      </table>
      {paths.length === 0 && <p class="empty">Nothing received of the link yet.</p>}
    </section>
  );
}

function Groups() {
  const groups = session.link.value?.groups ?? [];
  const most = Math.max(1, ...groups.map((group) => group.kbit_s));
  const total = groups.reduce((sum, group) => sum + group.kbit_s, 0);
  return (
    <section class="panel groups" aria-label="groups" tabIndex={0}>
      <h2>
        Groups down <span class="sum">{total.toFixed(1)} kbit/s</span>
      </h2>
      <table class="readings wide">
        <TableHead names={["group", "kbit/s", { spoken: "share" }, "age", "wanted"]} />
        <tbody>
          {groups.map((group) => (
            <tr key={group.group} data-over={group.age_ms > 2 * group.target_ms}>
              <th scope="row">{group.group}</th>
              <td>{group.kbit_s.toFixed(2)}</td>
              <td class="share">
                <i style={{ width: `${((100 * group.kbit_s) / most).toFixed(1)}%` }} />
              </td>
              <td>{group.age_ms < 0 ? kDash : ageText(group.age_ms)}</td>
              <td>{group.target_ms} ms</td>
            </tr>
          ))}
        </tbody>
      </table>
      {groups.length === 0 && <p class="empty">No figures by group yet.</p>}
    </section>
  );
}

function State() {
  const link = session.link.value;
  return (
    <section class="panel" aria-label="state" tabIndex={0}>
      <h2>
        Link {link ? link.state : kDash}
        {link && <AgeSince sinceMs={link.since_ms} />}
      </h2>
      <div class="lines two">
        <Line label="loss down, 5 s" path="link.down_loss" scale={100} decimals={1} unit="%" />
        <Line label="loss up, 5 s" path="link.up_loss" scale={100} decimals={1} unit="%" />
        <Line label="round trip" path="link.rtt_ms" decimals={1} />
        <Line label="jitter" path="link.jitter_ms" decimals={1} />
        <Line label="load down" path="link.down_kbit_s" decimals={1} />
        <Line label="cap down" path="link.down_cap_kbit_s" decimals={0} />
        <Line label="load up" path="link.up_kbit_s" decimals={1} />
        <Line label="worst age" path="link.worst_age_ms" decimals={0} />
        <Line label="silence of the car" path="link.silence_ms" decimals={0} />
        <Line label="stale groups" path="link.stale_groups" decimals={0} />
        <Line label="car hears the base" path="radio.base" />
        <Line label="car's link rule" path="radio.rung" />
      </div>
    </section>
  );
}

export function LinkPage() {
  return (
    <main class="page link-page">
      <div class="column">
        <State />
        <Paths />
        <Notices />
      </div>
      <div class="column">
        <BudgetPanel />
        <Groups />
      </div>
    </main>
  );
}
