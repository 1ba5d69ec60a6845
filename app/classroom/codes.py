"""The codes of a class: for joining, for coming back, and the instructor's PIN."""

from __future__ import annotations

import hashlib
import hmac
import secrets

ALPHABET = "2346789ABCDEFGHJKMNPQRTUVWXYZ"
"""Nothing in it is taken for something else: no 0 and O, 1, I and L, 5 and S."""

CLASS_CODE_LENGTH = 5
OWN_CODE_LENGTH = 8


def new_class_code() -> str:
    """Five characters: 20 million codes, and tries are limited."""
    return "".join(secrets.choice(ALPHABET) for _ in range(CLASS_CODE_LENGTH))


def own_code(secret: bytes, member_id: str) -> str:
    """A member's code for coming back, as "K7QF-2MWA".

    It follows from the class's secret and stands nowhere: no export, log or row holds it, and yet the member's page
    can show it after every restart. Whoever reads the class's file can work it out, as he could from a hash of so few
    characters; so that file is private.
    """
    number = int.from_bytes(hmac.digest(secret, member_id.encode(), "sha256"), "big")
    characters = []
    for _ in range(OWN_CODE_LENGTH):
        number, place = divmod(number, len(ALPHABET))
        characters.append(ALPHABET[place])
    code = "".join(characters)
    return f"{code[:4]}-{code[4:]}"


def plain_code(typed: str) -> str:
    """A code as it was meant, without hyphens and spaces, in capitals."""
    return "".join(character for character in typed[:40].upper() if character.isalnum())


def same_secret(typed: str, secret: str) -> bool:
    """Whether both are equal; it takes as long wherever they differ."""
    return hmac.compare_digest(typed.encode(), secret.encode())


def browser_hash(browser: str) -> str:
    """What the store knows a browser by: who reads the file cannot take its place."""
    return hashlib.sha256(browser.encode()).hexdigest()


def random_pin(digits: int = 4) -> str:
    """Digits that nobody can guess from the last ones."""
    return f"{secrets.randbelow(10**digits):0{digits}d}"
