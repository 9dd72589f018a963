"""Programs that end with us, however we end."""
import subprocess

# Reads until what we write to is closed, which our death does too, and ends the group that it leads.
GUARD = "trap '' INT TERM HUP; read -r _; kill -KILL 0"


class Ended:
    """A program and all that it starts. `close` ends them, and so does the end of this process, by any signal: a browser is the
    child of a script, and its own, busy with a shader, see too late that nobody asks any more."""

    def __init__(self, command, **more):
        self.guard = subprocess.Popen(["sh", "-c", GUARD], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL, process_group=0)
        self.process = subprocess.Popen(command, process_group=self.guard.pid, **more)
        self.pid, self.poll, self.stdout = self.process.pid, self.process.poll, self.process.stdout

    def close(self):
        self.guard.stdin.close()
        self.guard.wait()
        self.process.wait()
