"""Methods of a class that packages above it define: found by their names when they are used."""

from collections.abc import Callable
from types import MethodType
from typing import Any, ClassVar


class RegisteredMethod:
    """A method that a package above the class defines."""

    # returns a method by its name; the package that knows all others sets it
    find: ClassVar[Callable[[str], Callable[..., Any]]]

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: type | None = None) -> Any:  # noqa: ANN401 - methods have their own types
        """Return the method, bound to an object if there is one."""
        method = RegisteredMethod.find(self._name)
        return method if instance is None else MethodType(method, instance)
