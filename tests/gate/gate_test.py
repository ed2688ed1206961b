#!/usr/bin/env python3
"""What .ci/affected, .ci/part, .ci/run, .ci/ctest and tests/run decide: gate_test.py ROOT. Small trees of files stand for the repository."""
import contextlib
import fnmatch
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader('affected', str(ROOT / '.ci/affected'))
AFFECTED = importlib.util.module_from_spec(importlib.util.spec_from_loader('affected', loader))
loader.exec_module(AFFECTED)

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
    'samples/common/motion.hpp': 'int motion();',
    'samples/common/motion.cpp': '#include "common/motion.hpp"\n#include "common/random.hpp"',
    'samples/common/stdout_check.c': 'int check(void);',
    'samples/ensemble/CMakeLists.txt': '',
    'samples/grains/CMakeLists.txt': '',
    'samples/grains/main.cpp': '#include <supernormal/supernormal.h>\n#include "common/random.hpp"\n#include "model/scene.hpp"',
    'samples/grains/model/scene.hpp': 'int scene();',
    'samples/fit/CMakeLists.txt': '',
    'samples/fit/main.cpp': '#include <supernormal/contact/points.hpp>\n#include "model/scene.hpp"\n#include "../fit/model/scan.hpp"',
    'samples/fit/model/scan.hpp': '',
    'samples/fit/model/scene.hpp': 'int other_scene();',
    'samples/fit/README.md': '# Fit',
    'tests/contact/points_test.cpp': '#include "supernormal/contact/points.hpp"',
    'tests/support/world.hpp': 'int world();',
    'tests/fit/fit_test.cpp': '#include "support/world.hpp"\n#include "model/scene.hpp"',
    'tests/grains/grains_test.cpp': '#include "model/scene.hpp"\n#include "common/motion.hpp"',
}


def programs_of_tests(folder=''):
    recipes = [path.read_text(encoding='utf-8') for path in (ROOT / 'tests').glob(f'{folder or "**/"}CMakeLists.txt')]
    return {name for recipe in recipes for name in re.findall(r'^ *supernormal_add_doctest\(\s*(\w+)', recipe, re.MULTILINE)}


class Affected(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.committed = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.committed.cleanup)
        first = cls()
        first.tree = pathlib.Path(cls.committed.name)
        for name, text in FILES.items():
            first.write(name, text)
        first.git('init', '-q', '--template=')
        first.commit()

    def setUp(self):
        work = tempfile.TemporaryDirectory()
        self.addCleanup(work.cleanup)
        self.tree = pathlib.Path(work.name)
        shutil.copytree(self.committed.name, self.tree, dirs_exist_ok=True)

    def write(self, name, text):
        (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
        (self.tree / name).write_text(text + '\n', encoding='utf-8')

    def git(self, *arguments):
        subprocess.run(['git', '-c', 'user.name=x', '-c', 'user.email=x', '-c', 'core.fsync=none', *arguments], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)

    def commit(self):
        self.git('add', '-A')
        self.git('commit', '-qm', 'x')

    def affected(self, base='HEAD'):
        """By name, what the change of the working tree affects."""
        with contextlib.chdir(self.tree):
            return AFFECTED.affected_by(list(AFFECTED.changed_files(base)))

    def test_a_header_selects_its_users_and_three_at_most(self):
        self.write('lib/contact/inner.hpp', 'int inner(int);')
        units = self.affected()['units']
        self.assertEqual(len(units), 3)
        self.assertIn('lib/contact/inner.cpp', units)
        self.assertLess(units, {f'lib/contact/{name}.cpp' for name in ('inner', 'one', 'two', 'four')})

    def test_a_header_of_one_product_selects_no_file_of_another_with_a_header_of_that_name(self):
        self.write('samples/fit/model/scene.hpp', 'int changed();')
        self.assertEqual(self.affected(), {'units': {'samples/fit/main.cpp', 'tests/fit/fit_test.cpp'}, 'products': {'fit'}, 'others': set(), 'sanitized': set()})

    def test_a_page_selects_nothing_that_is_compiled(self):
        self.write('README.md', '# Another page')
        self.write('samples/fit/README.md', '# Another page')
        self.assertEqual(self.affected(), {'units': set(), 'products': set(), 'others': set(), 'sanitized': set()})

    def test_comments_alone_affect_nothing(self):
        self.write('include/supernormal/contact/points.hpp', '// other words\n/* and more */ int  points();')
        self.assertEqual(self.affected(), {'units': set(), 'products': set(), 'others': set(), 'sanitized': set()})

    def test_text_in_quotes_is_code(self):
        self.write('lib/contact/one.cpp', 'const char* url = "a//b";')
        self.commit()
        self.write('lib/contact/one.cpp', 'const char* url = "a//c";')
        self.assertEqual(self.affected()['units'], {'lib/contact/one.cpp'})

    def test_the_core_affects_every_product_and_its_own_sanitized_tests(self):
        self.write('lib/contact/points.cpp', 'int points() { return 2; }')
        self.assertEqual(self.affected(), {'units': {'lib/contact/points.cpp'}, 'products': {'ensemble', 'fit', 'grains'}, 'others': {'packaging'}, 'sanitized': {'tests_contact'}})

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
        self.assertEqual(self.affected()['products'], {'ensemble', 'fit', 'grains'})

    def test_a_shared_source_affects_those_that_link_it_by_another_one(self):
        self.write('samples/grains/main.cpp', 'int main() {}')
        self.commit()
        self.write('samples/common/random.cpp', 'int x;')
        self.assertEqual(self.affected()['products'], {'grains'})
        self.assertEqual(self.affected()['units'], {'samples/common/random.cpp'})

    def test_what_is_in_every_program_affects_every_product(self):
        self.write('samples/common/stdout_check.c', 'int x;')
        self.assertEqual(self.affected()['products'], {'ensemble', 'fit', 'grains'})

    def test_data_and_programs_affect_those_that_use_them(self):
        self.write('samples/scenes/short.toml', '')
        self.assertEqual(self.affected()['products'], {'ensemble', 'fit'})
        self.commit()
        self.write('samples/scenes/README.md', '')
        self.assertEqual(self.affected()['products'], set())
        self.commit()
        self.write('tests/cli_test.bash', '')
        self.assertEqual(self.affected()['products'], {'fit'})
        self.commit()
        self.write('samples/falling_particles/CMakeLists.txt', '')
        self.assertEqual(self.affected()['products'], {'ensemble', 'falling_particles'})

    def test_other_tests_than_those_of_products(self):
        for file, name in (('lib/packaging/supernormal.map', 'packaging'), ('tests/downstream/CMakeLists.txt', 'packaging'), ('lib/guide.md', 'packaging'),
                           ('lib/python/core.cpp', 'python'), ('samples/python/tour.py', 'python'), ('tests/falling_particles/viewers/check', 'viewers'),
                           ('samples/falling_particles/page/src/main.ts', 'viewers'), ('tests/ensemble/cluster/compare', 'cluster')):
            self.assertEqual(AFFECTED.others_of([file]), {name}, file)
        self.write('lib/guide.md', 'words')
        self.commit()
        self.write('lib/guide.md', 'other words')
        self.assertEqual(self.affected()['others'], set())
        self.write('lib/guide.md', '    a command')
        self.assertEqual(self.affected()['others'], {'packaging'})

    def test_the_rules_of_clang_tidy_affect_every_file(self):
        self.write('.clang-tidy', 'Checks: -*')
        self.assertEqual(self.affected()['units'], {name for name in FILES if name.endswith('.cpp')})

    def test_a_comment_that_clang_tidy_reads_counts(self):
        self.write('lib/contact/one.cpp', 'int* x = 0;  // NOLINT')
        self.commit()
        self.write('lib/contact/one.cpp', 'int* x = 0;  // none')
        self.assertEqual(self.affected()['units'], {'lib/contact/one.cpp'})

    def test_blanks_in_a_text_count(self):
        for text in ('const char* x = "{}";', 'const char* x = R"({}\n// {})";'):
            self.write('lib/contact/one.cpp', text.format('a b', 'c'))
            self.commit()
            for words in (('ab', 'c'), ('a b', 'd')):
                if text.format(*words) != text.format('a b', 'c'):
                    self.write('lib/contact/one.cpp', text.format(*words))
                    self.assertEqual(self.affected()['units'], {'lib/contact/one.cpp'}, text.format(*words))

    def test_a_header_that_is_gone_affects_those_that_include_it(self):
        (self.tree / 'samples/common/motion.hpp').unlink()
        self.assertEqual(self.affected()['products'], {'grains'})

    def test_a_product_that_is_gone_is_not_tested(self):
        shutil.rmtree(self.tree / 'samples/fit')
        self.assertEqual(self.affected()['products'], set())

    def test_a_header_above_the_folder_selects_its_users(self):
        self.write('samples/fit/model/scan.hpp', 'int x;')
        self.assertEqual(self.affected()['units'], {'samples/fit/main.cpp'})

    def test_a_name_may_have_blanks_and_any_letters(self):
        self.write('samples/fit/größe a.cpp', 'int x;')
        self.assertEqual(self.affected()['products'], {'fit'})
        self.commit()
        self.write('samples/fit/größe a.cpp', 'int y;')
        self.assertEqual(self.affected()['products'], {'fit'})

    def test_a_revision_that_is_not_there_is_named(self):
        result = subprocess.run([ROOT / '.ci/affected', '--since', 'nowhere', self.tree / 'out'], cwd=self.tree, check=False, stderr=subprocess.PIPE, text=True)
        self.assertEqual((result.returncode, result.stderr), (1, '.ci/affected: --since names no commit of this repository: nowhere\n'))

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
        self.assertEqual(self.affected('main')['products'], {'fit'})
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
        for name in ('lint_', 'lint_.', 'soa.', 'soak: 2.5e6 samples of the soak, 1e7 queries'):
            self.assertEqual(subprocess.run([ROOT / '.ci/part', name], stderr=subprocess.DEVNULL, check=False).returncode, 2, name)

    def test_each_part_has_a_command(self):
        text = (ROOT / '.ci/part').read_text(encoding='utf-8')
        patterns = [pattern for line in re.findall(r'^    ([\w*][\w*| ]*)\)', text, re.MULTILINE) for pattern in line.split(' | ')]
        for name in (line.split(':')[0] for line in self.part()):
            self.assertTrue([pattern for pattern in patterns if pattern != '*' and fnmatch.fnmatchcase(name, pattern)], name)

    def test_each_program_of_tests_is_in_one_sanitized_part(self):
        regexes = re.findall(r"^ *sanitized_\w+\) .ci/sanitized '(.*)' ;;$", (ROOT / '.ci/part').read_text(encoding='utf-8'), re.MULTILINE)
        self.assertEqual(len(regexes), len([line for line in self.part() if line.startswith('sanitized_')]))
        # The sanitized build is without fit and hosts (CMakePresets.json).
        for program in programs_of_tests() - {'tests_fit', 'tests_robot_model'}:
            self.assertEqual(len([regex for regex in regexes if re.search(regex, program)]), 1, program)

    def test_each_folder_of_the_library_and_each_program_of_its_tests_has_the_other(self):
        folders = {path.relative_to(ROOT / 'lib').parts[0] for path in (ROOT / 'lib').glob('*/**/*.cpp')} - {'python'}
        self.assertLessEqual(folders, AFFECTED.PROGRAMS.keys())
        self.assertEqual({name for names in AFFECTED.PROGRAMS.values() for name in names}, programs_of_tests('./') | programs_of_tests('soak/'))


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


class Alone(unittest.TestCase):
    def test_files_that_are_not_compiled_here_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder).resolve()
            for name in ('.ci', 'bin', 'build/debug'):
                (tree / name).mkdir(parents=True)
            shutil.copy(ROOT / '.ci/compile-alone', tree / '.ci')
            (tree / 'bin/cmake').symlink_to('/bin/true')
            shutil.copy('/bin/true', tree / 'build/debug/here.o')
            commands = f'  "command": "/usr/bin/c++ -o here.o -c {tree}/lib/here.cpp",\n'
            (tree / 'build/debug/compile_commands.json').write_text(commands, encoding='utf-8')
            (tree / 'files').write_text('lib/here.cpp\nlib/elsewhere.cpp\n', encoding='utf-8')
            environment = {**os.environ, 'PATH': f'{tree}/bin:{os.environ["PATH"]}'}
            result = subprocess.run([tree / '.ci/compile-alone', 'files'], env=environment, check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertIn('not compiled on this machine: lib/elsewhere.cpp\n', result.stderr)
            self.assertEqual(result.stdout, '1 of 2 files compile by themselves\n')


class Stages(unittest.TestCase):
    """.ci/run in a tree where each stage writes its words into a file, and fails or stops where a test says so."""

    def run_stages(self, *arguments, fails='', change=None):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder)
            script = f"""#!/bin/bash
words="${{0#{tree}/}} $*"
echo "$words" >>{tree}/said
[[ -z "{fails}" || "$words" != {fails or '-'}* ]]
"""
            programs = ['bin/cmake', 'bin/clang-format', 'tests/run', 'samples/run', 'build/release/tests/pairs']
            programs += [f'.ci/{name}' for name in ('install-packages', 'affected', 'ctest', 'lint', 'compile-alone', 'sanitized', 'part')]
            texts = {program: script for program in programs}
            texts['.ci/part'] = f'#!/bin/bash\ncase "$*" in\n"") printf "%s\\n" "first: x" "second: x" ;;\n--turn) echo first ;;\n*)\n{script};;\nesac\n'
            if fails == 'interrupt':
                texts['tests/run'] += 'trap "exit 2" INT\nkill -INT 0\n'
            for name in ('.ci/run', '.ci/usage.bash'):
                texts[name] = (ROOT / name).read_text(encoding='utf-8')
            texts['samples/falling_particles/main.cpp'] = texts['gone.cpp'] = texts['said'] = ''
            for name, text in texts.items():
                (tree / name).parent.mkdir(parents=True, exist_ok=True)
                (tree / name).write_text(text, encoding='utf-8')
                (tree / name).chmod(0o755)
            (tree / 'build/change').mkdir(parents=True)
            for name in ('units', 'products', 'others', 'sanitized'):
                (tree / 'build/change' / name).write_text(''.join(f'{word}\n' for word in (change or {}).get(name, [])), encoding='utf-8')
            subprocess.run('git init -q --template= && git -c core.fsync=none add -A', shell=True, cwd=tree, check=True)
            (tree / 'gone.cpp').unlink()
            (tree / 'new.cpp').touch()
            environment = {**os.environ, 'PATH': f'{tree}/bin:{os.environ["PATH"]}'}
            result = subprocess.run([tree / '.ci/run', *arguments], cwd=tree, env=environment, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                    text=True, start_new_session=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            return result.returncode, (tree / 'said').read_text(encoding='utf-8').splitlines(), result.stdout.splitlines()

    def test_what_a_change_affects_is_run_and_no_more(self):
        change = {'units': ['a.cpp'], 'products': ['fit', 'falling_particles'], 'others': ['python', 'packaging'], 'sanitized': ['tests_a', 'tests_b']}
        code, said, lines = self.run_stages(change=change)
        self.assertEqual((code, lines[-1]), (0, 'all passed'))
        wanted = ['.ci/lint --most 16 build/change/units', '.ci/compile-alone build/change/alone', 'tests/run library falling_particles fit', 'tests/run python',
                  'tests/run packaging', '.ci/sanitized ^(tests_a|tests_b)$', 'samples/run --scene samples/scenes/short.toml', '.ci/part first']
        self.assertEqual([words for words in said if words in wanted], wanted)
        self.assertEqual([words for words in self.run_stages()[1] if words in wanted], [wanted[-2], wanted[-1]])

    def test_files_that_git_does_not_know_are_formatted_and_those_that_are_gone_are_not(self):
        format_ = next(words for words in self.run_stages()[1] if words.startswith('bin/clang-format'))
        self.assertIn('new.cpp', format_)
        self.assertNotIn('gone.cpp', format_)

    def test_it_stops_at_a_failure(self):
        code, said, lines = self.run_stages(fails='tests/run')
        self.assertEqual((code, lines[-1]), (1, 'FAILED'))
        self.assertIn('tests/run library', said[-1])

    def test_with_all_it_goes_on_after_a_failure(self):
        code, said, lines = self.run_stages('--all', fails='tests/run')
        self.assertEqual((code, lines[-1]), (1, 'FAILED'))
        self.assertEqual(said[-2:], ['.ci/part first', '.ci/part second'])
        self.assertEqual(len([line for line in lines if ' FAILED ' in line]), 3)

    def test_with_all_it_stops_where_the_user_interrupts_it(self):
        code, said, lines = self.run_stages('--all', fails='interrupt')
        self.assertEqual((code, lines[-1]), (1, 'FAILED'))
        self.assertEqual(said[-1], 'tests/run --all')

    def test_what_is_not_there_is_refused_before_anything_starts(self):
        for arguments in (['--part', 'fir.t'], ['--since', 'nowhere'], ['--what']):
            self.assertEqual(self.run_stages(*arguments)[:2], (2, []), arguments)


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
    if not shutil.which('git') or not (ROOT / '.git').exists():
        print('skipped: this is no checkout, or git is not installed')
        sys.exit(77)
    unittest.main()
