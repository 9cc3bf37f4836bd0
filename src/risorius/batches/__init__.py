"""Many lines at once: read from a manifest, performed by warm processes, resumable after any end.

`manifest` reads rows, `jobs` makes each a checked job, one of the `executors` performs them by `perform`,
and `run` keeps the `journal` and the `report`.
"""
