# Sourced by the scripts here, after cli/common.bash: sets chromium, and skips the test without it or Node.js.

chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "no Chromium"
command -v node >/dev/null || skip "no Node.js"
