#!/usr/bin/env bash
# links.sh EPICYCLIC SOURCE_DIR
#
# No reference of the repository leads to what is not in it:
#
#   [text](path#section) of a page    the path is there, and the section is a heading of that page
#   NAME.md, section 2.1  (comments and pages; "sections 1 to 3", "sections 1 and 3" too)
#                                     there is such a page, with headings of these numbers: "## 2. ...", "### 2.1 ..."
#
# A page is named by its path, or by the end of it. Names of pages that the program writes are those in quotes in its
# source. Examples in pages, which are blocks of code, are not read, and this file is not.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.bash"
source_dir=$2

# Prints what leads nowhere below a folder, and at last how many references were read.
references() {
  perl -CSD - "$1" <<'PERL'
use strict;
use warnings;
use utf8;
use File::Find;
use File::Spec;

my $root = $ARGV[0];
my (@files, %kind);
find({no_chdir => 1, preprocess => sub { grep { !/^\.git$/ && !($File::Find::dir eq $root && /^(build|out|shared)$/) } @_ },
      wanted => sub {
        return unless -f $_ && !-l $_;
        my $path = substr($_, length($root) + 1);
        return if $path eq 'tests/cli/links.sh';
        my $kind = $path =~ /\.md$/ ? 'page'
          : $path =~ /\.(cpp|hpp|inc|sh|bash|cmake|py|m|js|yml)$|CMakeLists\.txt$/ ? 'code'
          : $path !~ m{\.[^/]*$} && -T $_ ? 'code' : '';
        $kind{$path} = $kind;
        push @files, $path if $kind;
      }}, $root);

sub text_of {
  open my $in, '<:encoding(UTF-8)', "$root/$_[0]" or die "$_[0]: $!";
  local $/;
  my $text = <$in>;
  return defined $text ? $text : '';
}

# Headings as anchors, and their numbers.
my (%anchors, %numbers);
for my $page (grep { $kind{$_} eq 'page' } @files) {
  my ($inside, %seen) = (0);
  for (split /\n/, text_of($page)) {
    $inside = !$inside if /^\s*```/;
    next if $inside;
    $anchors{$page}{$1} = 1 while /<a (?:id|name)="([^"]*)"/g;
    next unless /^#+\s+(.*?)\s*$/;
    my $heading = $1;
    $numbers{$page}{$1} = 1 if $heading =~ /^(\d+(?:\.\d+)*)[. ]/;
    $heading =~ s/\[([^\]]*)\]\([^)]*\)/$1/g;
    my $slug = lc $heading;
    $slug =~ s/[^\w\- ]//g;
    $slug =~ s/ /-/g;
    my $again = $seen{$slug}++;
    $anchors{$page}{$again ? "$slug-$again" : $slug} = 1;
  }
}

# Pages that the program writes.
my %written;
for my $file (grep { m{^(?:lib|app)/.*\.[ch]pp$} } @files) {
  my $text = text_of($file);
  $written{$1} = 1 while $text =~ /"(?:[^"\n]*[\/ ])?([\w.-]+\.md)[^"\n]*"/g;
}

my %ends;
for my $page (grep { $kind{$_} eq 'page' } @files) {
  my @parts = split m{/}, $page;
  push @{$ends{join '/', @parts[$_ .. $#parts]}}, $page for 0 .. $#parts;
}

my ($read, @wrong) = (0);
for my $file (@files) {
  my $text = text_of($file);
  my ($volume, $folder) = File::Spec->splitpath($file);
  if ($kind{$file} eq 'page') {
    $text =~ s/^\s*```.*?^\s*```[^\n]*$//gms;
    while ($text =~ /\]\(([^()\s]*)(?:\s+"[^"]*")?\)/g) {
      my $target = $1;
      next if $target =~ m{^[a-z]+:};
      ++$read;
      my ($path, $section) = $target =~ /^([^#]*)(?:#(.*))?$/;
      my $at = $file;
      if ($path ne '') {
        my @way = split m{/}, $folder;
        for (split m{/}, $path) { $_ eq '..' ? pop @way : $_ eq '.' || push @way, $_ }
        $at = join '/', @way;
      }
      if (!-e "$root/$at") { push @wrong, "$file points at $target, which is not there" }
      elsif (defined $section && $kind{$at} && !$anchors{$at}{$section}) {
        push @wrong, "$file points at $target, a section that is not there";
      }
    }
  }
  $text =~ s/^    .*$//gm if $kind{$file} eq 'page';
  $text =~ s{\$\{?\w+\}?/}{ }g if $kind{$file} eq 'code';
  # A reference may go over the end of a line of comments.
  $text =~ s{\s*\n[ \t]*(?://+<?|#+|\*)?[ \t]*}{ }g;
  $text =~ s/\]\([^()\s]*\)/]/g;
  while ($text =~ m{((?:[\w.\-]+/)*[\w\-]+\.md)\b(?:,? sections? (\d+(?:\.\d+)*)(?: (to|and) (\d+(?:\.\d+)*))?)?}g) {
    my ($name, $first, $joint, $last) = ($1, $2, $3, $4);
    ++$read;
    (my $end = $name) =~ s{^(?:\.\.?/)+}{};
    (my $own = $end) =~ s{.*/}{};
    my @pages = @{$ends{$end} || []};
    @pages = grep { m{^\Q$folder\E[^/]*$} } @pages if grep { m{^\Q$folder\E[^/]*$} } @pages;
    if (!@pages) {
      push @wrong, "$file names $name, which is no page" unless $written{$own};
      next;
    }
    next unless defined $first;
    my @sections = defined $last ? $joint eq 'to' && "$first$last" =~ /^\d+$/ ? ($first .. $last) : ($first, $last) : ($first);
    for my $section (@sections) {
      push @wrong, "$file names section $section of $name, which is not there" unless grep { $numbers{$_}{$section} } @pages;
    }
  }
}
print "$_\n" for @wrong;
print "$read references\n";
PERL
}

# Made wrong one by one, each is found, and nothing else.
mkdir -p small/docs small/lib
write_small() {
  printf '%s\n' '# Small' '' 'See [units](docs/units.md#2-of-time) and docs/units.md, section 1.' >small/README.md
  printf '%s\n' '# Units' '' '## 1. Of length' '' '## 2. Of time' '' '### 2.1 The `second`' >small/docs/units.md
  printf '%s\n' '// As in docs/units.md, sections 1 and 2.1; a long line goes on, units.md, section' '// 2, and "of" report.md.' \
    'const char* written = "report.md";' >small/lib/unit.cpp
}
write_small
[ "$(references small)" = "6 references" ] || fail "the small example is right: $(references small)"
while IFS='|' read -r file from to said; do
  write_small
  grep -qF -- "$from" "small/$file" || fail "$file of the small example has no $from"
  sed -i "s|$from|$to|" "small/$file"
  [ "$(references small)" = "$said"$'\n'"6 references" ] || fail "$file, $from made $to: $(references small)"
done <<'CASES'
README.md|docs/units.md#2|docs/unit.md#2|README.md points at docs/unit.md#2-of-time, which is not there
README.md|#2-of-time|#2-of-mass|README.md points at docs/units.md#2-of-mass, a section that is not there
README.md|section 1|section 3|README.md names section 3 of docs/units.md, which is not there
README.md|and docs/units.md|and docs/scales.md|README.md names docs/scales.md, which is no page
lib/unit.cpp|1 and 2.1|1 and 2.2|lib/unit.cpp names section 2.2 of docs/units.md, which is not there
lib/unit.cpp|// 2, and|// 7, and|lib/unit.cpp names section 7 of units.md, which is not there
lib/unit.cpp|"report.md"|"reports.md"|lib/unit.cpp names report.md, which is no page
CASES

found=$(references "$source_dir")
count=$(tail -n 1 <<<"$found")
[ "${count%% *}" -ge 200 ] || fail "only $count were found"
while IFS= read -r line; do fail "$line"; done < <(head -n -1 <<<"$found")
echo "$count"
finish
