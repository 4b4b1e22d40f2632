"""Answers the cases of bench/sparql/compare with rdflib: rdflib_peer.py DATA.nt CASES.json

Prints {"version", "queries": {name: {"us", "rows"}}}: the median of one prepared query with its anchor bound, and
the rows of each anchor as N-Triples' terms, of as many anchors as there is time for. Exit status 77 where rdflib is not installed.
"""
import json
import statistics
import sys
import time

try:
    import rdflib
    from rdflib.plugins.sparql import prepareQuery
    from rdflib.util import from_n3
except ImportError:
    print("python3-rdflib is not installed")
    sys.exit(77)

ENOUGH_S = 0.5  # of measuring, for each query, with every anchor at least once
MOST_S = 20  # then the remaining anchors are left out


def rows_of(result, columns):
    if columns is None:
        return [["true" if result.askAnswer else "false"]]
    return [[row[column].n3() if row[column] is not None else "-" for column in columns] for row in result]


def main():
    graph = rdflib.Graph()
    graph.parse(sys.argv[1], format="nt")
    answers = {}
    for case in json.load(open(sys.argv[2])):
        query = prepareQuery(case["text"])
        bindings = [dict(zip(case["parameters"], map(from_n3, anchor))) for anchor in case["anchors"]]
        times, answer = [], []
        spent = 0.0
        while spent < (MOST_S if len(answer) < len(bindings) else ENOUGH_S):
            start = time.perf_counter()
            rows = rows_of(graph.query(query, initBindings=bindings[len(times) % len(bindings)]), case["columns"])
            times.append(time.perf_counter() - start)
            spent += times[-1]
            if len(answer) < len(bindings):
                answer.append(rows)
        answers[case["name"]] = {"us": statistics.median(times) * 1e6, "rows": answer}
    json.dump({"version": rdflib.__version__, "queries": answers}, sys.stdout)


if __name__ == "__main__":
    main()
