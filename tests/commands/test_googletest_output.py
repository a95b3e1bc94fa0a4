"""What the test suite reads off a GoogleTest program."""

from _lib.test_googletest import read_output

GOOD = """[ RUN      ] A.Works
[       OK ] A.Works (0 ms)
[ RUN      ] A.IsLeftOut
[  SKIPPED ] A.IsLeftOut (0 ms)
"""

BAD = """[ RUN      ] B.Breaks/1
b.cpp:7: Failure
[  FAILED  ] B.Breaks/1, where GetParam() = fan 3, open (12 ms)
"""

SUMMARY = """[  PASSED  ] 1 test.
[  FAILED  ] 1 test, listed below:
[  FAILED  ] B.Breaks/1, where GetParam() = fan 3, open
"""


def test_tests_are_counted():
    outcome = read_output(GOOD, 0)
    assert (outcome.passed, outcome.failed, outcome.skipped) == (1, 0, 1)
    assert outcome.output == ""


def test_what_failed_is_shown_and_counted_once():
    outcome = read_output(GOOD + BAD + SUMMARY, 1)
    assert (outcome.passed, outcome.failed, outcome.skipped) == (1, 1, 1)
    assert "b.cpp:7: Failure" in outcome.output
    assert "A.Works" not in outcome.output


def test_a_program_that_dies_names_the_test_it_died_in():
    outcome = read_output(GOOD + "[ RUN      ] C.Crashes\n==7==ERROR: AddressSanitizer\n", -6)
    assert (outcome.passed, outcome.failed) == (1, 1)
    assert "C.Crashes" in outcome.output
    assert "AddressSanitizer" in outcome.output


def test_a_failure_of_no_test_is_one():
    outcome = read_output(GOOD, 1)
    assert (outcome.passed, outcome.failed) == (1, 1)
