"""Speaks as `congruent watch --format json` does, for the tests of the bridge: a joint that jumps is a violation of `limits`."""

import json
import sys

LIMIT_RAD = 0.2


def say(kind: str, **values: object) -> None:
    print(json.dumps({"kind": kind, **values}), flush=True)


def main() -> int:
    until_violation = "--until-violation" in sys.argv
    before: dict[str, float] = {}
    violated, lines, poses = False, 0, 0
    say("started", robot=sys.argv[1], checks=["limits"])
    for text in sys.stdin:
        try:
            line = json.loads(text)
        except ValueError:
            say("bad_line", message=f"no JSON: {text.strip()}")
            continue
        lines += 1
        if "pose" in line:
            poses += 1
            say("pose", time_s=line["time_s"], origin=line["origin"], **line["pose"])
            continue
        jumps = {joint: q - before[joint] for joint, q in line["q"].items() if abs(q - before.get(joint, q)) > LIMIT_RAD}
        before = line["q"]
        for joint, jump in jumps.items():
            violated = True
            message = f"{joint} jumps by {jump:.3g} rad, limit {LIMIT_RAD} rad"
            say("violation", check="limits", time_s=line["time_s"], joint=joint, jump_rad=jump, limit_rad=LIMIT_RAD, message=message)
            if until_violation:
                say("finished", verdict="fail", lines=lines)
                return 1
    say("finished", verdict="fail" if violated else "pass", lines=lines, poses=poses)
    return int(violated)


if __name__ == "__main__":
    sys.exit(main())
