"""serve.py EPICYCLIC SLOW: a client of `serve`, as its page and as somebody else, in the folder of serve.sh.

Times may be SLOW times as long as in a build without sanitizers.
"""
import atexit
import http.client
import json
import os
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

program = sys.argv[1]
slow_by = float(sys.argv[2])
failures = 0


def expect(holds, what):
    global failures
    if not holds:
        print("FAILED:", what)
        failures += 1


class Server:
    def __init__(self, *folders):
        # Its errors go to a file, so that a full pipe cannot stop it.
        self.errors = open("server.err", "w+")
        self.process = subprocess.Popen([program, "serve", *folders, "--threads", "2"], stdout=subprocess.PIPE,
                                        stderr=self.errors, text=True)
        atexit.register(self.process.kill)
        line = self.process.stdout.readline()
        found = re.fullmatch(r"open http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/\n", line)
        expect(found, f"it prints {line!r}")
        self.port, self.token = int(found[1]), found[2]

    def ask(self, method, path, body=None, timeout=300, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.request(method, path, body, named)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, dict(answer.getheaders()), content

    def post(self, action, value, **headers):
        status, _, content = self.ask("POST", f"/{self.token}/{action}", json.dumps(value),
                                      Content_Type="application/json", **headers)
        return status, json.loads(content) if content[:1] == b"{" else content

    def state(self):
        return self.post("state", {})[1]

    def until(self, holds, what, seconds=30):
        end = time.time() + slow_by * seconds
        while time.time() < end:
            state = self.state()
            if holds(state):
                return state
            time.sleep(0.05)
        expect(False, f"never: {what}: {state}")
        return state

    def alive(self):
        return self.process.poll() is None

    def end(self, number=signal.SIGTERM):
        begun = time.time()
        self.process.send_signal(number)
        code = self.process.wait(20 * slow_by)
        return code, time.time() - begun


def raw(server, text, wait=0.0):
    """The status that a text is answered with; 0: the connection was closed, or is not answered in `wait` seconds."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=10) as link:
        try:
            link.sendall(text)
            if wait:
                link.settimeout(wait)
            answer = link.recv(65536)
        except OSError:
            return 0
        return int(answer.split()[1]) if answer.startswith(b"HTTP/1.1 ") else 0


def run(*arguments):
    return subprocess.run([program, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode


server = Server("sweep")
home = f"/{server.token}/"
host = f"127.0.0.1:{server.port}"

# The page, and its policy.
status, headers, page = server.ask("GET", home)
expect(status == 200 and headers["Content-Type"] == "text/html; charset=utf-8", "the page")
expect(b"default-src 'none'; script-src 'sha256-" in page and b"connect-src 'self'" in page, "its policy")
expect(headers.get("Cache-Control") == "no-store" and headers.get("X-Frame-Options") == "DENY" and
       headers.get("Referrer-Policy") == "no-referrer", "its headers")
expect(server.ask("GET", home, Host=f"localhost:{server.port}")[0] == 200, "by the name localhost")

expect(run("serve", "sweep", "--port", str(server.port)) == 2, "two servers have one port")

# Loopback alone.
own = [line.split() for line in open("/proc/net/tcp").read().splitlines()[1:]]
places = [parts[1] for parts in own if parts[3] == "0A" and parts[1].endswith(":%04X" % server.port)]
expect(places == ["0100007F:%04X" % server.port], f"it listens at {places}")

# The study, and a history of one of its points.
status, data = server.post("data", {"study": 0})
expect(status == 200 and len(data) > 10000, "the study")
status, history = server.post("history", {"study": 0, "point": 4, "periods": 16})
expect(status == 200 and len(history["columns"]["delta_sp_1"]) == 16 * 32 + 1, "a history")


# ---- what is not answered

def hostile():
    other = "0" * 32
    json_type = {"Content_Type": "application/json"}
    answers = [
        ("no token", server.ask("GET", "/")[0]),
        ("another token", server.ask("GET", f"/{other}/")[0]),
        ("part of the token", server.ask("GET", f"/{server.token[:-1]}/")[0]),
        ("the token without its end", server.ask("GET", f"/{server.token}")[0]),
        ("another token, POST", server.ask("POST", f"/{other}/state", "{}", **json_type)[0]),
        ("another host", server.ask("GET", home, Host="example.org")[0]),
        ("another port", server.ask("GET", home, Host="127.0.0.1:1")[0]),
        ("a host that begins alike", server.ask("GET", home, Host=f"{host}.example.org")[0]),
        ("another origin", server.ask("POST", home + "state", "{}", Origin="http://example.org", **json_type)[0]),
        ("the origin null", server.ask("POST", home + "state", "{}", Origin="null", **json_type)[0]),
        ("https", server.ask("POST", home + "state", "{}", Origin=f"https://{host}", **json_type)[0]),
        ("a form", server.ask("POST", home + "state", "a=1", Content_Type="application/x-www-form-urlencoded")[0]),
        ("parts", server.ask("POST", home + "state", "--a", Content_Type="multipart/form-data; boundary=a")[0]),
        ("plain text", server.ask("POST", home + "state", "{}", Content_Type="text/plain")[0]),
        ("GET of an action", server.ask("GET", home + "state")[0]),
        ("POST to the page", server.ask("POST", home, "{}", **json_type)[0]),
        ("a huge body", server.ask("POST", home + "state", "{" + " " * 65536 + "}", **json_type)[0]),
        ("a folder", server.ask("GET", home + "run.json")[0]),
        ("a query", server.ask("GET", home + "?a=1")[0]),
    ]
    for method in ["PUT", "DELETE", "PATCH", "OPTIONS", "HEAD", "TRACE", "CONNECT", "BREW"]:
        answers.append((method, server.ask(method, home)[0]))
    for path in ["../", "../sweep/run.json", "%2e%2e/", "..%2f..%2fetc/passwd", "./", "/", "state/../", "%00", "\\..\\", "STATE"]:
        answers.append((path, server.ask("GET", home + path)[0]))
        answers.append((path, server.ask("POST", home + path, "{}", **json_type)[0]))
    for body in ["", "{", "[]", "1", "null", '{"study": 0', '{"a": 1, "a": 2}', "[" * 5000, '{"study": 1e999}', "\xff",
                 '{"a":' * 40 + "1" + "}" * 40, "{} {}", '{"study": 0} // x']:
        answers.append((f"body {body[:20]}", server.ask("POST", home + "data", body.encode("latin-1"), **json_type)[0]))
    region = {"study": 0, "from": 2.1, "to": 2.2, "values": 5, "records": 1}
    for name, value in [("study", 1), ("study", -1), ("study", 0.5), ("study", "0"), ("study", "../sweep"), ("from", "2"),
                        ("from", 2.3), ("from", None), ("to", [1]), ("values", 1), ("values", 1e9), ("values", 2.5),
                        ("records", 0), ("records", 1000), ("folder", "../elsewhere"), ("from", -1e308)]:
        answers.append((f"refine {name}={value}", server.post("refine", {**region, name: value})[0]))
    for numbers in [[], [{}], [1], {}, "x", [{"number": 0, "value": "0"}], [{"number": 10**6, "value": 1}],
                    [{"number": -1, "value": 1}], [{"number": "/stage", "value": 1}], [{"number": 0, "value": -1e9}],
                    [{"number": 0, "value": 1, "pointer": "/name"}], [{"number": k, "value": 1} for k in range(5)]]:
        answers.append((f"change {numbers}", server.post("change", {"study": 0, "numbers": numbers, "coarse": True})[0]))
    for point in [-1, 18, 1.5, "1", 1e30]:
        answers.append((f"point {point}", server.post("history", {"study": 0, "point": point, "periods": 4})[0]))
    answers.append(("periods", server.post("history", {"study": 0, "point": 1, "periods": 10**6})[0]))
    head = f"POST {home}state HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n".encode()
    page_head = f"GET {home} HTTP/1.1\r\n".encode()
    for name, text in [
        ("two hosts", page_head + f"Host: {host}\r\nHost: example.org\r\n\r\n".encode()),
        ("no host", page_head + b"\r\n"),
        ("two lengths", head + b"Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}"),
        ("a negative length", head + b"Content-Length: -1\r\n\r\n{}"),
        ("no length", head + b"\r\n"),
        ("a length of words", head + b"Content-Length: 2x\r\n\r\n{}"),
        ("chunks", head + b"Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n"),
        ("compressed", head + b"Content-Encoding: gzip\r\nContent-Length: 2\r\n\r\n{}"),
        ("a long line", b"GET /" + b"a" * 9000 + b" HTTP/1.1\r\n\r\n"),
        ("many headers", page_head + b"".join(b"a%d: b\r\n" % k for k in range(3000)) + b"\r\n"),
        ("a zero", f"GET {home}\0 HTTP/1.1\r\nHost: {host}\r\n\r\n".encode()),
        ("a folded header", page_head + f"Host: {host}\r\n  more\r\n\r\n".encode()),
        ("no colon", page_head + f"Host: {host}\r\nnothing\r\n\r\n".encode()),
        ("HTTP/9.9", f"GET {home} HTTP/9.9\r\nHost: {host}\r\n\r\n".encode()),
        ("no request", b"\r\n\r\n"),
        ("bytes", bytes(range(256)) + b"\r\n\r\n"),
    ]:
        answers.append((name, raw(server, text, wait=5.5)))
    return answers


def noise(count):
    """Requests of random parts, with a wrong token each."""
    chance = random.Random(1)
    for _ in range(count):
        method = chance.choice(["GET", "POST", "PUT", "", "G ET", "\x01", "get"])
        path = "/" + "".join(chance.choice(["a", "0", "/", ".", "..", "%", "%2e", "\\", "?", "#", "{", "é"])
                             for _ in range(chance.randrange(60)))
        lines = [chance.choice([f"Host: {host}", "Host: a", "Range: bytes=0-,0-,0-", "Expect: 100-continue",
                                "Upgrade: websocket", "Connection: keep-alive", "Content-Length: 99999999999999999999",
                                "Cookie: a=b", "X: " + "y" * 500, ":", "a"]) for _ in range(chance.randrange(8))]
        yield f"{method} {path} HTTP/1.1\r\n" + "".join(line + "\r\n" for line in lines) + "\r\n{}"


before = len(server.state()["studies"])
answers = hostile()
count = len(answers)
for name, status in answers:
    expect(status == 0 or 400 <= status < 500 or status == 501, f"{name} is answered with {status}")
for text in noise(500 - count):
    status = raw(server, text.encode(), wait=0.05)
    count += 1
    expect(status == 0 or status >= 400, f"{text[:80]!r} is answered with {status}")
expect(count == 500, f"{count} hostile requests")
# What was taken for a region or for numbers that are not valid has left no folder.
expect(len(server.state()["studies"]) == before and not os.path.exists("sweep/refined") and
       not os.path.exists("sweep/changed"), "a hostile request has made a folder")
expect(server.alive(), "the server has ended")

# Slow senders are cut off, and others are served meanwhile.
slow = []
ended = []


def trickle(text, step):
    begun = time.time()
    with socket.create_connection(("127.0.0.1", server.port), timeout=20) as link:
        try:
            for byte in text:
                link.sendall(bytes([byte]))
                link.settimeout(step)
                try:
                    if not link.recv(10):
                        break
                except socket.timeout:
                    pass
        except OSError:
            pass
    ended.append(time.time() - begun)


endless = f"GET {home} HTTP/1.1\r\nHost: {host}\r\nX: ".encode() + b"y" * 1000
long_body = f"POST {home}state HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\nContent-Length: 5000\r\n\r\n{{".encode()
tls = b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200)
slow.append(threading.Thread(target=trickle, args=(tls, 0.5)))
for _ in range(10):
    slow.append(threading.Thread(target=trickle, args=(endless, 0.5)))
    slow.append(threading.Thread(target=trickle, args=(long_body + b" " * 100, 0.5 if len(slow) % 4 else 0.05)))
for thread in slow:
    thread.start()
time.sleep(0.3)
begun = time.time()
expect(server.ask("GET", home)[0] == 200 and time.time() - begun < 3.5 * slow_by, "nobody is served while others send slowly")

# ---- a region, finer, while the slow ones are still there

status, made = server.post("refine", {"study": 0, "from": 2.12, "to": 2.16, "values": 5, "records": 2})
expect(status == 202 and made == {"study": 1, "folder": "sweep/refined/001"}, f"a region: {made}")
expect(server.post("refine", {"study": 0, "from": 2.12, "to": 2.16, "values": 5, "records": 1})[0] == 409, "two at a time")
state = server.until(lambda s: s["computing"] is None, "the region")
expect(state["last"] == {"study": 1, "code": 0, "message": ""}, f"the region: {state['last']}")
resolved = json.load(open("sweep/refined/001/input.resolved.json"))["study"]
expect((resolved["from"], resolved["to"], resolved["points"], resolved["recorded_periods"]) == (2.12, 2.16, 5, 32),
       f"the region's study: {resolved}")
expect(state["studies"][1]["command"] == "epicyclic sweep sweep/refined/001/input.resolved.json -o sweep/refined/001",
       "the command of a region")
expect(run("sweep", "sweep/refined/001/input.resolved.json", "-o", "sweep/refined/001") == 0, "the command of a region fails")
for thread in slow:
    thread.join()
expect(max(ended) < 8 * slow_by, f"a slow sender had {max(ended):.1f} s")

# ---- numbers of the input

begun = time.time()
status, made = server.post("change", {"study": 0, "numbers": [{"number": 0, "value": 0.1}], "coarse": True})
expect(status == 202 and made["folder"] == "sweep/changed/001", f"another number: {made}")
state = server.until(lambda s: s["computing"] is None, "another number")
print(f"coarse diagram: {time.time() - begun:.2f} s")
expect(state["studies"][2]["how"]["changes"] == [{"name": "damping_ratio", "number": 0, "unit": "", "value": 0.1}],
       f"what was changed: {state['studies'][2]['how']}")
lumped = json.load(open("sweep/changed/001/input.resolved.json"))["stage"]["lumped"]
expect(lumped["sun_planet_mesh"]["damping_ratio"] == lumped["ring_planet_mesh"]["damping_ratio"] == 0.1, "both meshes")

# ---- cancelled, and resumed by its command; a signal; killed

long = {"study": 0, "from": 2.1, "to": 2.3, "values": 2000, "records": 1}
folder = server.post("refine", long)[1]["folder"]
server.until(lambda s: s["computing"] and s["computing"]["done"] > 0, "points of a long region")
expect(server.post("change", {"study": 0, "numbers": [{"number": 0, "value": 0.2}], "coarse": True})[0] == 409,
       "a slider stops a region")
begun = time.time()
server.post("cancel", {})
state = server.until(lambda s: s["computing"] is None, "the end after cancelling")
expect(state["last"]["code"] == 75 and time.time() - begun < 5 * slow_by, f"cancelled: {state['last']}")
expect(json.load(open(f"{folder}/run.json"))["state"] == "stopped", "the folder of what was cancelled")
expect(server.post("refine", {**long, "values": 3})[0] == 202, "another one after it")
server.until(lambda s: s["computing"] is None, "another one after it")

folder = server.post("refine", long)[1]["folder"]
server.until(lambda s: s["computing"] and s["computing"]["done"] > 0, "points before a signal")
code, seconds = server.end(signal.SIGINT)
expect(code == 75 and seconds < 3 * slow_by, f"a signal: code {code} after {seconds:.1f} s")
expect(json.load(open(f"{folder}/run.json"))["state"] in ("stopped", "running"), "the folder after a signal")

# What an earlier session has computed is there again. Killed while it computes: the folder resumes.
server = Server("sweep", "unfinished")
expect(len(server.state()["studies"]) == 7, f"after a new start: {len(server.state()['studies'])}")
small = {"study": 0, "from": 2.1, "to": 2.3, "values": 24, "records": 1}
folder = server.post("refine", small)[1]["folder"]
server.until(lambda s: s["computing"] and s["computing"]["done"] > 3, "points before a kill")
server.process.kill()
server.process.wait()
expect(json.load(open(f"{folder}/run.json"))["state"] == "running", "the folder of what was killed")
size = os.path.getsize(f"{folder}/journal.bin")
expect(run("sweep", f"{folder}/input.resolved.json", "-o", folder) == 0, "what was killed is not resumed")
expect(json.load(open(f"{folder}/run.json"))["state"] == "complete" and
       os.path.getsize(f"{folder}/journal.bin") > size, "it is not complete")

# ---- a study that another process computes

shutil.rmtree("growing", ignore_errors=True)
writer = subprocess.Popen([program, "sweep", "sweep/input.resolved.json", "--set", "/study/points=2000", "-o", "growing",
                           "--threads", "1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
while not os.path.exists("growing/input.resolved.json"):
    time.sleep(0.02)
server = Server("growing")
server.until(lambda s: server.post("data", {"study": 0})[0] == 200, "the first points")
expect(server.post("history", {"study": 0, "point": 1999, "periods": 4})[0] == 409, "a history of what is not finished")
size = len(server.post("data", {"study": 0})[1])
server.until(lambda s: len(server.post("data", {"study": 0})[1]) > size, "more points")
writer.terminate()
writer.wait()
code, seconds = server.end()
expect(code == 0 and seconds < 3 * slow_by, f"the end: code {code} after {seconds:.1f} s")
sys.exit(failures > 0)
