"""How hypothesis draws: the same cases in every run; new ones with --hypothesis-profile=search."""

from datetime import timedelta

from hypothesis import HealthCheck, settings

SLOW = [HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large]

settings.register_profile(
    "repeatable",
    derandomize=True,
    deadline=None,
    database=None,
    print_blob=False,
    suppress_health_check=SLOW,
)
settings.register_profile("search", deadline=None, suppress_health_check=SLOW, max_examples=1000)
settings.register_profile("gentle", deadline=timedelta(seconds=60))
settings.load_profile("repeatable")
