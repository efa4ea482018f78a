"""The two walks of docs/architecture.md: each is followed by callgrind, and the files that it
enters are those that the page lists, no more and no fewer.

  call    walks_test.py SOURCE_TREE WALK_PROGRAM [--print]
  in      the walk's program (walk.cpp), linked with the lines of its sources
  out     exit code 0, or the lists as they should be; --print: the lists alone

Which of two threads is first at a queue decides on some lines: a file may be missed once, and
must be entered in one of TRIES walks; one that is not listed must never be.
A file is entered when an instruction of one of its lines is executed, inlined ones too. Files of
a pair count as one. What a tick, a turn or a packet does beside the value is another walk: SIDE
says which functions begin one, and why. Lines of a class or a namespace of SIDE that the compiler
has put into a caller are its lines still.
SPDX-License-Identifier: Apache-2.0
"""
import collections
import os
import re
import subprocess
import sys
import tempfile

TRIES = 4
EVERYWHERE = ("protocol/vocabulary/", "protocol/transport/clock", "protocol/transport/posix_call",
              "protocol/transport/control_data", "protocol/transport/bench_clock/")

SIDE = {
    "what else a tick does": [
        "localization::", "tracking::", "planning::", "control::", "steering::", "safety::",
        "rules::", "pipeline::map_opponents", "gateway::encode",
        "gateway::handshake", "gateway::identify", "gateway::store_command",
        "gateway::observe_link", "gateway::judge_frozen", "gateway::BusLoad",
        "pipeline::map_health", "pipeline::conclude", "pipeline::TickLog",
        "pipeline::RadioAdapter::take", "pipeline::RadioAdapter::show", "io::BlackBox",
        "io::BusWatch", "io::LinkObserver", "io::ReceiverPort",
        "io::CarIo::write", "io::CarIo::poll_bus"],
    "how sockets and clocks are kept": [
        "transport::CanSocket::follow_clock", "transport::CanSocket::poll_drops",
        "transport::CanSocket::arrival", "transport::CanInterface", "transport::monotonic_now",
        "transport::realtime_minus", "transport::utc_now", "transport::wait_readable",
        "transport::sleep_until"],
    "how a link is kept: receipts, budget, paths, keys, what else is in a packet": [
        "telemetry::ReceivedPackets", "telemetry::SentPackets", "telemetry::PathReceipts",
        "telemetry::ClockSync", "telemetry::LinkStats", "telemetry::PathBudget",
        "telemetry::RateControl", "telemetry::PathChoice", "telemetry::ThreatMonitor",
        "telemetry::SchemaExchange", "telemetry::Joystick", "telemetry::PathLane",
        "telemetry::Responder", "telemetry::put", "telemetry::Bulk", "telemetry::EventReceiver",
        "telemetry::EventSender", "telemetry::LinkEndpoint::add_path_records",
        "telemetry::LinkEndpoint::path_records_size", "telemetry::LinkEndpoint::take_path_records",
        "telemetry::LinkEndpoint::take_ack", "telemetry::LinkEndpoint::report",
        "telemetry::LinkEndpoint::plan", "telemetry::LinkEndpoint::begin",
        "telemetry::LinkEndpoint::note_session", "telemetry::LinkEndpoint::exchange",
        "telemetry::LinkEndpoint::sendable_groups", "telemetry::LinkEndpoint::round_trip",
        "telemetry::Association::opening_due", "telemetry::Association::poll_size",
        "telemetry::Association::note_sent", "telemetry::StationEndpoint::due",
        "telemetry::CarEndpoint::due", "link::AgeStatistics", "link::PacketRate",
        "link::LinkMeter", "service::LinkMonitor"],
    "what else a turn of the base does": [
        "service::CarService::advance", "service::CarService::identity", "session::", "inputs::",
        "state::Trend", "alarms::Evaluator::advance"],
    "how consoles and their sockets are kept": [
        "publishers::console::ClientRegistry::identify",
        "publishers::console::ClientRegistry::greet_new_clients",
        "publishers::console::PauseReport", "publishers::web::memory_use",
        "publishers::web::short_of_memory", "publishers::web::reserve_is_held",
        "publishers::web::TokenStore"],
}
# A walk's own: what goes the other way, or somewhere else.
OTHER_WAY = {
    "frame": [
        "telemetry::CommandLedger", "link::Station::poll", "io::Radio::receive",
        "pipeline::RadioAdapter::fill", "pipeline::execute",
        "publishers::console::ConsoleService::submit"],
    "command": [
        "gateway::decode", "pipeline::map_telemetry", "io::Radio::send", "io::CarIo::read",
        "service::CarService::receive", "publishers::console::ConsoleService::publish",
        "publishers::console::ConsoleService::packet",
        "publishers::web::WebServer::Engine::deliver",
        "publishers::web::WebServer::Engine::Socket::write"],
}


def followed(program, walk, folder):
    """callgrind's record of one walk."""
    out = os.path.join(folder, walk + ".out")
    ran = subprocess.run(
        ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--callgrind-out-file=" + out,
         "--compress-strings=no", "--compress-pos=no", program, walk],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
    if ran.returncode != 0:
        sys.exit(f"the walk {walk} did not arrive (code {ran.returncode}):\n{ran.stdout}")
    return out


def in_tree(path, root):
    """The path as it lies under the root. A compiler cache that several checkouts share names files
    by the checkout that was compiled first, and relative to its build folder."""
    path = os.path.normpath(path)
    inside = re.search(
        r"/((?:build/\w+/generated/)?(?:protocol|vehicle|basestation|hil|tests)/.*)$", path)
    here = os.path.join(root, inside[1]) if inside else path
    return here if os.path.exists(here) else path


def calls_of(record, root):
    """Of each function: files of its own lines, and functions that it calls. A function is
    (file, name)."""
    lines, calls = collections.defaultdict(set), collections.defaultdict(set)
    function = file = called_file = called = None
    is_call = False
    with open(record, encoding="utf-8") as text:
        for row in text:
            key, equals, value = row.rstrip("\n").partition("=")
            if equals and key in ("fl", "fi", "fe"):
                file = in_tree(value, root)
            elif equals and key == "fn":
                function = (file, value)
            elif equals and key in ("cfi", "cfl"):
                called_file = in_tree(value, root)
            elif equals and key == "cfn":
                called = value
            elif equals and key == "calls":
                calls[function].add((called_file or file, called))
                called_file, is_call = None, True
            elif row[:1].isdigit() or row[:1] in "+-*":
                if not is_call and function:
                    lines[function].add(file)
                is_call = False
    return lines, calls


def name_of(function):
    name = function[1].replace("(anonymous namespace)::", "").split("(")[0]
    return name.split(" ")[-1].removeprefix("pitwall::")


def namespace_of(path):
    """The namespace of a source of the product, without pitwall."""
    with open(path, encoding="utf-8") as text:
        found = re.search(r"^namespace pitwall::([\w:]+) {", text.read(), re.MULTILINE)
    return found[1] if found else ""


def is_of_side(path, others):
    """Whether the file is that of a class of SIDE (link::LinkMeter: link_meter), or all of its
    namespace is (inputs::). A function of SIDE (io::CarIo::write) has no file of its own."""
    name, _ = os.path.splitext(os.path.basename(path))
    for other in others:
        space, _, last = other.rpartition("::")
        snake = re.sub(r"(?<!^)(?=[A-Z])", "_", last).lower()
        is_class = last[:1].isupper() and snake == name
        if (is_class or not last) and namespace_of(path) == space:
            return True
    return False


def walked_files(record, walk, root):
    """Product files that the walk enters, without the suffixes of pairs."""
    lines, calls = calls_of(record, root)
    others = [begin for begins in SIDE.values() for begin in begins] + OTHER_WAY[walk]
    callees = {callee for some in calls.values() for callee in some}
    # What is followed begins in the program's own step and in the web server's thread.
    waiting = [f for f in set(lines) | set(calls)
               if f not in callees and ("follow<" in f[1] or "scheduler::run" in f[1])]
    seen = set()
    while waiting:
        function = waiting.pop()
        if function in seen:
            continue
        seen.add(function)
        for callee in calls.get(function, ()):
            if not name_of(callee).startswith(tuple(others)):
                waiting.append(callee)
    files = set()
    for function in seen:
        for path in lines.get(function, ()):
            inside = path.partition(root + "/")[2]
            if not inside or inside.startswith(("tests/", *EVERYWHERE)):
                continue
            if not is_of_side(path, others):
                files.add(re.sub(r"^build/\w+/generated/", "", re.sub(r"\.[ch]pp$", "", inside)))
    return files


def listed(files):
    """A line of the page for each folder."""
    folders = collections.defaultdict(list)
    for path in sorted(files):
        folder, _, name = path.rpartition("/")
        folders[folder].append(name)
    rows = sorted(folders.items())
    return "".join(f"- `{folder}`: {', '.join(names)}\n" for folder, names in rows)


def block_of(walk, files):
    return f"<!-- walk: {walk}, {len(files)} files -->\n{listed(files)}<!-- end -->"


def main():
    root, program = os.path.realpath(sys.argv[1]), sys.argv[2]
    prints = "--print" in sys.argv
    with open(os.path.join(root, "docs/architecture.md"), encoding="utf-8") as text:
        page = text.read()
    different = False
    with tempfile.TemporaryDirectory() as folder:
        for walk in OTHER_WAY:
            files = set()
            for _ in range(TRIES):
                files |= walked_files(followed(program, walk, folder), walk, root)
                if not prints and block_of(walk, files) in page:
                    break
            else:
                different = True
                print(block_of(walk, files))
    if different and not prints:
        print("docs/architecture.md lists other files: as above is how the walks go now")
    return 1 if different and not prints else 0


if __name__ == "__main__":
    sys.exit(main())
