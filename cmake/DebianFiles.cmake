# Makes of the installed files those that Debian's policy asks for: `copyright`, the changes and the manual page
# compressed without a time of day in them. CPack runs it before it packs.
set(doc ${CPACK_TEMPORARY_DIRECTORY}/usr/share/doc/ramus)
file(READ ${doc}/LICENSE license)
file(WRITE ${doc}/copyright "ramus\n\n${license}")
file(REMOVE ${doc}/LICENSE)

file(COPY_FILE ${CPACK_RAMUS_CHANGELOG} ${doc}/changelog)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH, where it is set
file(WRITE ${doc}/changelog.Debian
"ramus (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=low

  * Version ${CPACK_PACKAGE_VERSION}; changelog.gz has the changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
execute_process(COMMAND gzip --best --no-name --force changelog changelog.Debian ../../man/man1/ramus.1
                WORKING_DIRECTORY ${doc} COMMAND_ERROR_IS_FATAL ANY)
