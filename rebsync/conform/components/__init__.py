"""Recordings of nodes that people wrote, of which only topics are seen.

Each node is compared for itself, as an open component: what it receives comes when the recording
says, and what it publishes must be what its class in the extracted model sends. `environment`
closes the model with a node at the other end of all topics, `interface` reads from it who is on
which topic, `inclusion` searches for a run of one component, `comparison` gives the answer.
"""
