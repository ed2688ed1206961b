#!/usr/bin/env python3
"""What .ci/affected, .ci/part, .ci/ctest and tests/run decide: gate_test.py ROOT. Small trees of files stand for the repository."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()

FILES = {
    'CMakeLists.txt': 'project(x)',
    'README.md': '# A page',
    'include/supernormal/supernormal.h': 'int snInit(void);',
    'include/supernormal/effects.hpp': '#include "supernormal/supernormal.h"',
    'include/supernormal/contact/points.hpp': '// points\nint points();',
    'lib/CMakeLists.txt': '',
    'lib/contact/points.cpp': '#include "supernormal/contact/points.hpp"\nint points() { return 1; }',
    'lib/contact/inner.hpp': 'int inner();',
    'lib/contact/one.cpp': '#include "contact/inner.hpp"',
    'lib/contact/two.cpp': '#include "contact/inner.hpp"',
    'lib/contact/inner.cpp': '#include "contact/inner.hpp"',
    'lib/contact/four.cpp': '#include "contact/one.hpp"',
    'lib/contact/one.hpp': '#include "contact/inner.hpp"',
    'lib/ode/world.cpp': '#include "supernormal/supernormal.h"',
    'lib/python/core.cpp': '',
    'samples/CMakeLists.txt': '',
    'samples/common/CMakeLists.txt': '',
    'samples/common/random.hpp': 'int random_number();',
    'samples/common/random.cpp': '#include "common/random.hpp"',
    'samples/grains/CMakeLists.txt': '',
    'samples/grains/main.cpp': '#include <supernormal/supernormal.h>\n#include "common/random.hpp"\n#include "model/scene.hpp"',
    'samples/grains/model/scene.hpp': 'int scene();',
    'samples/fit/CMakeLists.txt': '',
    'samples/fit/main.cpp': '#include <supernormal/contact/points.hpp>\n#include "model/scene.hpp"',
    'samples/fit/model/scene.hpp': 'int other_scene();',
    'samples/fit/README.md': '# Fit',
    'tests/contact/points_test.cpp': '#include "supernormal/contact/points.hpp"',
    'tests/support/world.hpp': 'int world();',
    'tests/fit/fit_test.cpp': '#include "support/world.hpp"\n#include "model/scene.hpp"',
    'tests/grains/grains_test.cpp': '#include "model/scene.hpp"',
}


class Affected(unittest.TestCase):
    def setUp(self):
        work = tempfile.TemporaryDirectory()
        self.addCleanup(work.cleanup)
        self.tree = pathlib.Path(work.name)
        for name, text in FILES.items():
            self.write(name, text)
        self.git('init', '-q')
        self.commit()

    def write(self, name, text):
        (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
        (self.tree / name).write_text(text + '\n', encoding='utf-8')

    def git(self, *arguments):
        subprocess.run(['git', '-c', 'user.name=x', '-c', 'user.email=x', *arguments], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)

    def commit(self):
        self.git('add', '-A')
        self.git('commit', '-qm', 'x')

    def affected(self, *arguments):
        """By name, what the change of the working tree affects."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ROOT / '.ci/affected', *(arguments or ('--since', 'HEAD')), folder], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)
            return {file.name: set(file.read_text(encoding='utf-8').split()) for file in pathlib.Path(folder).iterdir()}

    def test_a_header_selects_its_users_and_three_at_most(self):
        self.write('lib/contact/inner.hpp', 'int inner(int);')
        units = self.affected()['units']
        self.assertEqual(len(units), 3)
        self.assertIn('lib/contact/inner.cpp', units)
        self.assertLess(units, {f'lib/contact/{name}.cpp' for name in ('inner', 'one', 'two', 'four')})

    def test_a_header_of_one_product_selects_no_file_of_another_with_a_header_of_that_name(self):
        self.write('samples/fit/model/scene.hpp', 'int changed();')
        self.assertEqual(self.affected(), {'units': {'samples/fit/main.cpp', 'tests/fit/fit_test.cpp'}, 'products': {'fit'}, 'sanitized': set()})

    def test_a_page_selects_nothing_that_is_compiled(self):
        self.write('README.md', '# Another page')
        self.write('samples/fit/README.md', '# Another page')
        self.assertEqual(self.affected(), {'units': set(), 'products': set(), 'sanitized': set()})

    def test_comments_alone_affect_nothing(self):
        self.write('include/supernormal/contact/points.hpp', '// other words\n/* and more */ int  points();')
        self.assertEqual(self.affected(), {'units': set(), 'products': set(), 'sanitized': set()})

    def test_text_in_quotes_is_code(self):
        self.write('lib/contact/one.cpp', 'const char* url = "a//b";')
        self.commit()
        self.write('lib/contact/one.cpp', 'const char* url = "a//c";')
        self.assertEqual(self.affected()['units'], {'lib/contact/one.cpp'})

    def test_the_core_affects_every_product_and_its_own_sanitized_tests(self):
        self.write('lib/contact/points.cpp', 'int points() { return 2; }')
        self.assertEqual(self.affected(), {'units': {'lib/contact/points.cpp'}, 'products': {'fit', 'grains'}, 'sanitized': {'tests_contact'}})

    def test_the_ode_layer_affects_what_includes_its_header(self):
        self.write('lib/ode/world.cpp', 'int x;')
        found = self.affected()
        self.assertEqual(found['products'], {'grains'})
        self.assertEqual(found['sanitized'], {'tests_ode', 'tests_ode_heightfield', 'tests_ode_allocation'})

    def test_what_is_shared_affects_those_that_include_it(self):
        self.write('samples/common/random.cpp', 'int x;')
        self.assertEqual(self.affected()['products'], {'grains'})
        self.git('checkout', '-q', '.')
        self.write('tests/support/world.hpp', 'int x;')
        self.assertEqual(self.affected()['products'], {'fit'})

    def test_the_build_affects_every_product(self):
        self.write('samples/common/CMakeLists.txt', 'x()')
        self.assertEqual(self.affected()['products'], {'fit', 'grains'})

    def test_a_file_that_is_gone_and_one_that_is_new_count(self):
        (self.tree / 'samples/fit/main.cpp').unlink()
        self.write('samples/grains/new.cpp', 'int x;')
        found = self.affected()
        self.assertEqual(found['products'], {'fit', 'grains'})
        self.assertEqual(found['units'], {'samples/grains/new.cpp'})

    def test_a_branch_is_compared_with_the_main_one(self):
        self.git('branch', '-M', 'main')
        self.git('checkout', '-qb', 'change')
        self.write('samples/fit/main.cpp', 'int x;')
        self.commit()
        self.assertEqual(self.affected('--since', 'main')['products'], {'fit'})
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ROOT / '.ci/affected', folder], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)
            self.assertEqual((pathlib.Path(folder) / 'products').read_text(encoding='utf-8'), 'fit\n')


class Parts(unittest.TestCase):
    def part(self, *arguments):
        return subprocess.run([ROOT / '.ci/part', *arguments], check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()

    def test_each_commit_has_the_next_turn(self):
        names = [line.split(':')[0] for line in self.part()]
        self.assertEqual(len(names), len(set(names)))
        count = int(subprocess.run(['git', 'rev-list', '--count', 'HEAD'], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout)
        turns = names.index('single_precision')  # the first that takes none
        self.assertEqual(self.part('--turn'), [names[count % turns]])

    def test_no_part_has_a_wrong_name(self):
        self.assertEqual(subprocess.run([ROOT / '.ci/part', 'lint_'], stderr=subprocess.DEVNULL, check=False).returncode, 2)


class Names(unittest.TestCase):
    """What tests/run builds and runs, in a tree where nothing is installed, built or run."""

    def run_names(self, *arguments, products=('falling_particles', 'fit')):
        """Exit code, the targets of ninja, and the groups of tests."""
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder)
            said = {'cmake': 'targets', '.ci/install-packages': 'packages', '.ci/ctest': 'groups'}
            for program, file in said.items():
                path = tree / (program if '/' in program else f'bin/{program}')
                path.parent.mkdir(exist_ok=True)
                path.write_text(f'#!/bin/sh\nfor word; do echo "$word"; done >>"{tree}/{file}"\n', encoding='utf-8')
                path.chmod(0o755)
            for name in ('tests/run', '.ci/usage.bash'):
                (tree / name).parent.mkdir(exist_ok=True)
                shutil.copy(ROOT / name, tree / name)
            for product in products:
                (tree / 'samples' / product).mkdir(parents=True)
                (tree / 'samples' / product / 'CMakeLists.txt').touch()
            environment = {**os.environ, 'PATH': f'{tree}/bin:{os.environ["PATH"]}'}
            code = subprocess.run([tree / 'tests/run', *arguments], env=environment, stderr=subprocess.DEVNULL, check=False).returncode
            return code, *((tree / file).read_text(encoding='utf-8').splitlines() if code == 0 else [] for file in ('targets', 'groups'))

    def test_without_a_name_the_library_what_is_shared_and_falling_particles(self):
        code, targets, groups = self.run_names()
        self.assertEqual(code, 0)
        self.assertLessEqual({'lib/all', 'tests/all', 'tests/common/all', 'falling_particles'}, set(targets))
        self.assertLess({'build/release', 'tests/common'}, set(groups))
        self.assertEqual({group.split()[0] for group in groups}, {'build/release', 'tests', 'tests/common', 'samples/falling_particles'})

    def test_without_falling_particles_the_library(self):
        code, _, groups = self.run_names(products=())
        self.assertEqual((code, {group.split()[0] for group in groups}), (0, {'build/release', 'tests', 'tests/common'}))

    def test_the_package_of_python_has_the_scenes(self):
        self.assertIn('samples/falling_particles -R ^python', self.run_names('python')[2])

    def test_what_is_no_name_is_refused_before_anything_starts(self):
        for arguments in ([''], ['common'], ['fit/'], ['../tests'], ['--what'], ['--sanitize', 'fit'], ['--sanitize', 'packaging']):
            self.assertEqual(self.run_names(*arguments)[0], 2, arguments)


class Summary(unittest.TestCase):
    """.ci/ctest on a build of commands."""

    def run_tests(self, *tests):
        with tempfile.TemporaryDirectory() as folder:
            text = ''.join(f'add_test({name} {command})\nset_tests_properties({name} PROPERTIES SKIP_RETURN_CODE 77)\n' for name, command in tests)
            (pathlib.Path(folder) / 'CTestTestfile.cmake').write_text(text, encoding='utf-8')
            result = subprocess.run([ROOT / '.ci/ctest', folder, '.'], check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            return result.returncode, result.stdout.splitlines()

    def test_skipped_tests_are_named_with_their_reason(self):
        code, lines = self.run_tests(('good', '/bin/true'), ('left', '/bin/sh -c "echo skipped: no browser; exit 77"'))
        self.assertEqual((code, lines[-2:]), (0, ['skipped: left: no browser', '1 passed, 0 failed, 1 skipped']))

    def test_a_failure_is_named_and_fails(self):
        code, lines = self.run_tests(('good', '/bin/true'), ('bad', '/bin/false'))
        self.assertEqual((code, lines[-2:]), (1, ['FAILED: bad', '1 passed, 1 failed, 0 skipped']))

    def test_a_test_that_cannot_run_fails(self):
        code, lines = self.run_tests(('good', '/bin/true'), ('unbuilt', '/nowhere/program'))
        self.assertEqual((code, lines[-2:]), (1, ['FAILED: unbuilt', '1 passed, 1 failed, 0 skipped']))

    def test_nothing_that_ran_fails(self):
        self.assertEqual(self.run_tests()[0], 1)


if __name__ == '__main__':
    unittest.main()
