"""Sending deliveries, in a thread of its own: no request ever waits for another service."""

from __future__ import annotations

import logging
import threading
import time

import httpx

from backend.store.database import Database
from backend.store.errors import StoreUnavailable
from backend.store.webhooks import Taken, note_sent, plan_deliveries, take_delivery
from backend.webhooks.messages import (
    DELIVERY_HEADER,
    EVENT_HEADER,
    SIGNATURE_HEADER,
    TIMESTAMP_HEADER,
    body_of,
    sign,
)
from backend.webhooks.targets import Resolve, Target, find_target
from sldr_core.errors import SldrError

LOOK_INTERVAL_S = 5.0
"""Between two looks for something to tell [s]."""
ANSWER_S = 10.0
"""How long another service may take for each step of answering [s]."""
END_S = 1.0
"""How long the end of this service waits for a message on its way; it would be sent again [s]."""

log = logging.getLogger("sldr.webhooks")


class Sender:
    """Tell other services what has ended."""

    def __init__(self, db: Database, allow_local: bool, resolve: Resolve | None = None) -> None:
        """Prepare to send.

        Args:
            allow_local: whether services on this machine may be told.
            resolve: asks for the addresses of a name; the system's way if None.
        """
        self._db = db
        self._allow_local = allow_local
        self._resolve = resolve
        self._wake = threading.Event()
        self._is_over = False
        self._thread = threading.Thread(target=self._work, name="webhooks", daemon=True)

    def start(self) -> None:
        """Begin to look, again and again."""
        self._thread.start()

    def wake(self) -> None:
        """Let it look at once."""
        self._wake.set()

    def stop(self) -> None:
        """End; what was not sent is sent by the next service."""
        self._is_over = True
        self._wake.set()
        self._thread.join(END_S)

    def tick(self) -> int:
        """Make what deliveries there are to make, and send all that are due; return how many were tried."""
        plan_deliveries(self._db, body_of)
        tried = 0
        while not self._is_over and (taken := take_delivery(self._db)) is not None:
            problem = send(taken, self._allow_local, self._resolve)
            note_sent(self._db, taken, problem)
            if problem is not None:
                log.warning("Delivery %s, try %d: %s", taken.delivery.id, taken.delivery.tries, problem)
            tried += 1
        return tried

    def _work(self) -> None:
        while not self._is_over:
            self._wake.wait(LOOK_INTERVAL_S)
            self._wake.clear()
            if self._is_over:
                return
            try:
                self.tick()
            except StoreUnavailable as err:
                log.warning("Nothing is sent just now: %s", err)
            except Exception:
                # The thread must live on: whatever went wrong here may not go wrong with the next message.
                log.exception("Sending broke down.")


def send(taken: Taken, allow_local: bool, resolve: Resolve | None = None) -> str | None:
    """Send one delivery; return why it did not arrive, in one sentence, or None if it did."""
    try:
        target = find_target(taken.url, allow_local, resolve)
        status = _post(target, taken)
    except SldrError as err:
        return str(err)
    except httpx.TimeoutException:
        return f"The service did not answer within {ANSWER_S:g} s."
    except httpx.HTTPError as err:
        return f"The service could not be reached ({err or type(err).__name__})."
    return None if 200 <= status < 300 else f"The service answered with status {status}."


def _post(target: Target, taken: Taken) -> int:
    """Send to the judged address, under the name as written; return the status. The answer's body is not read."""
    body, now = taken.delivery.body.encode(), int(time.time())
    url = httpx.URL(target.url)
    headers = {
        "Host": url.netloc.decode(),
        "Content-Type": "application/json",
        "User-Agent": "sldr-webhooks",
        SIGNATURE_HEADER: sign(taken.secret, now, body),
        TIMESTAMP_HEADER: str(now),
        DELIVERY_HEADER: taken.delivery.id,
        EVENT_HEADER: taken.delivery.event,
    }
    with (
        httpx.Client(trust_env=False, follow_redirects=False, timeout=ANSWER_S) as client,
        client.stream(
            "POST",
            url.copy_with(host=target.address),
            content=body,
            headers=headers,
            extensions={"sni_hostname": target.host},
        ) as answer,
    ):
        return answer.status_code
