"""The messages between the page of the studio and its server: these dataclasses are the contract.

A request is JSON `{"id": 7, "do": VERB, …fields}`. The answer is `{"re": 7, "ok": {…}}` or `{"re": 7,
"error": "one line"}`. What the server sends without a request is an event: `{"event": NAME, …fields}`.
`browser/wire.js` is generated from these classes by `studio/wire_javascript.py`. Times are seconds; curves
are base64 of little-endian float32.
"""
