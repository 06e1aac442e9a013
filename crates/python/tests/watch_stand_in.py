"""Answers as `congruent watch --format json` does, for the tests of the bridge, with one check: no joint beyond pi.

The lines that it gets are appended to the file of STAND_IN_LINES, if that is set.
"""

import json
import math
import os
import sys


def say(kind: str, **values: object) -> None:
    print(json.dumps({"kind": kind, **values}), flush=True)


def change(line: dict[str, dict[str, float]], joint: str) -> dict[str, object]:
    values = {"value": abs(line["q"][joint]) - math.pi, "limit": 1e-6, "unit": "rad", "bound": "at_most", "where": joint}
    return {"time_s": line["time_s"], "check": "limits", "number": 1, "quantity": "angle_beyond_limit", **values}


def main() -> int:
    until_violation = "--until-violation" in sys.argv
    samples, has_failed, outside = 0, False, ""
    lines = open(os.environ.get("STAND_IN_LINES", os.devnull), "a")
    for text in sys.stdin:
        line = json.loads(text)
        print(text, end="", file=lines, flush=True)
        if "q" not in line:
            continue
        samples += 1
        if samples == 1:
            say("started", robot="ur5e", joints=list(line["q"]), held=[], rate_hz=500.0, checks=["limits"], taken=[])
        beyond = [joint for joint, q in line["q"].items() if abs(q) > math.pi]
        if beyond and not outside:
            outside, has_failed = beyond[0], True
            say("violation", **change(line, outside))
            if until_violation:
                break
        elif outside and not beyond:
            say("recovered", **change(line, outside))
            outside = ""
    verdict = "not_as_expected" if has_failed else "pass"
    report = {"checks": [{"check": "limits", "status": "fail" if has_failed else "pass", "measures": []}]}
    say("finished", verdict=verdict, exit_code=int(has_failed), counts={"samples": samples, "gaps": 0}, report=report)
    return int(has_failed)


if __name__ == "__main__":
    sys.exit(main())
