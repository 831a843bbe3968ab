#!/usr/bin/env python3
"""Sends the readings of a CSV file to truepose-agent, one by one, and seals the session.

    agent_client.py 127.0.0.1:7900 ur10 readings.csv

The file has a line a reading: the joints in degrees, then x y z of the target in mm, with commas. Start it again after any failure:
the session's id, kept in readings.csv.id, and the number of each reading make every message repeatable.
"""
import json
import os
import socket
import sys
import time
import uuid


class Agent:
    """Asks until it is answered, over as many connections as that takes."""

    def __init__(self, address):
        host, _, port = address.rpartition(":")
        self.address = (host, int(port))
        self.file = None
        self.greeting = None  # what a new connection begins with

    def _connect(self):
        connection = socket.create_connection(self.address, timeout=10)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.file = connection.makefile("rw", encoding="utf-8", newline="\n")
        if self.greeting:
            self._exchange(self.greeting)

    def _exchange(self, message):
        self.file.write(json.dumps(message) + "\n")
        self.file.flush()
        line = self.file.readline()
        if not line.endswith("\n"):
            raise OSError("the connection ended")
        return json.loads(line)

    def ask(self, message):
        while True:
            try:
                if self.file is None:
                    self._connect()
                answer = self._exchange(message)
            except OSError:
                self.file = None
                time.sleep(0.2)
                continue
            if answer["ok"]:
                return answer
            # Its disk is full or can't be written: nothing was taken, the same message works later.
            if answer["code"] not in ("RESOURCE_EXHAUSTED", "UNAVAILABLE"):
                sys.exit("agent_client: " + answer["message"])
            time.sleep(1)


def session_id(path):
    """Made once for a file: a repeated begin finds the same session."""
    name = path + ".id"
    if not os.path.exists(name):
        with open(name + ".new", "w", encoding="ascii") as file:
            file.write(str(uuid.uuid4()))
        os.replace(name + ".new", name)
    with open(name, encoding="ascii") as file:
        return file.read().strip()


def main():
    address, robot, path = sys.argv[1:4]
    with open(path, encoding="utf-8") as file:
        rows = [[float(value) for value in line.split(",")] for line in file if line.strip()]
    agent = Agent(address)
    begin = {"op": "begin", "robot": robot, "id": session_id(path), "source": os.path.basename(path)}
    begun = agent.ask(begin)
    agent.greeting = begin
    if not begun["sealed"]:
        for number in range(begun["readings"] + 1, len(rows) + 1):
            row = rows[number - 1]
            agent.ask({"op": "reading", "number": number, "joints_deg": row[:-3], "position_mm": row[-3:]})
        agent.ask({"op": "seal", "readings": len(rows)})
    print(f"{len(rows)} readings are safe in {begun['session']}")


if __name__ == "__main__":
    main()
